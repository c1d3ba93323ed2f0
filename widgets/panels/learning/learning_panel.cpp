#include "widgets/panels/learning/learning_panel.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>
#include <QSettings>

#include "core/base/error.h"
#include "core/base/software.h"
#include "core/base/units.h"
#include "core/learning/model/correction_source.h"
#include "widgets/panels/learning/ablation_view.h"
#include "widgets/panels/learning/clouds_view.h"
#include "widgets/panels/learning/confidence_view.h"
#include "widgets/panels/learning/curve_view.h"
#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/learning/learning_pages.h"
#include "widgets/panels/learning/table_picker.h"
#include "widgets/panels/learning/trajectory_view.h"
#include "widgets/scene/cloud_view.h"

namespace capstan::widgets {

using namespace learning;

LearningPanel::LearningPanel(LearningSettings settings, QWidget* parent)
    : WorkPanel(parent), settings_(std::move(settings)) {
  makeButtons();
  addHead(picker_ = new TablePicker, train_, tr("result of learning"));
  addBody(pages_ = new LearningPages);
  addFoot({model_button_, export_button_}, tr("state of learning"));
  connect(picker_, &TablePicker::changed, this, &LearningPanel::read);
  connect(&pages_->ablation(), &AblationView::runRequested, this, &LearningPanel::runAblation);
  connect(&pages_->curve(), &CurveView::runRequested, this, &LearningPanel::runCurve);
  connect(&job_, &Job::failed, this, [this](const QString& why) { failed_ = why; });
  connect(&job_, &Job::ended, this, &LearningPanel::onEnded);
  connect(&job_, &Job::progressed, this, &LearningPanel::onProgress);
  connect(&export_, &LearningExport::progressed, this, &LearningPanel::onProgress);
  connect(&export_, &LearningExport::ended, this, [this](const QString& folder, const QString& words) {
    said_ = words;
    if (!folder.isEmpty()) Q_EMIT exported(folder);
    refresh();
  });
  setTheme(theme_);
  refresh();
}

LearningPanel::~LearningPanel() = default;

void LearningPanel::makeButtons() {
  train_ = button("train", tr("Train"), QString(), [this] { trainOrCancel(); });
  model_button_ =
      button("save_model", tr("Save model…"), tr("The correction as a file that others load (Ctrl+Shift+S)"),
             [this] { askModel(); });
  export_button_ =
      button("export_learning", tr("Export…"),
             tr("Figures, the ablation table and the rejected states, into a folder (Ctrl+Shift+E)"),
             [this] { askFolder(); });
  addKey("F6", [this] { runAblation(); });
  addKey("F7", [this] { runCurve(); });
  addKey("Ctrl+Shift+S", model_button_);
  addKey("Ctrl+Shift+E", export_button_);
}

void LearningPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  picker_->setTheme(theme);
  pages_->setTheme(theme);
  styleWords(theme);
}

void LearningPanel::save(QSettings& settings) const {
  picker_->choice().save(settings);
  settings.setValue("learning/splits", pages_->ablation().splits());
}

void LearningPanel::restore(const QSettings& settings) {
  picker_->setChoice(LearningChoice::restore(settings));
  pages_->ablation().setSplits(settings.value("learning/splits", pages_->ablation().splits()).toInt());
  if (isVisible()) read();
  refresh();
}

void LearningPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (!results_.stages && doing_ == Doing::kNothing && !choice().tables.isEmpty()) read();
}

void LearningPanel::choose(const LearningChoice& choice) {
  picker_->setChoice(choice);
  read();
}

const LearningChoice& LearningPanel::choice() const { return picker_->choice(); }

void LearningPanel::read() {
  results_ = {};
  pages_->showResults(results_);
  said_.clear();
  failed_.clear();
  doing_ = Doing::kNothing;
  export_.cancel();
  read_again_ = job_.busy();
  if (read_again_) {
    job_.cancel();
  } else if (!choice().tables.isEmpty()) {
    begin(Doing::kReading, tr("reading"));
    job_.start([choice = choice(), settings = settings_](
                   base::Progress& progress) { return readStages(choice, settings, progress); },
               [this](LearningStages stages) {
                 results_.stages = std::make_shared<const LearningStages>(std::move(stages));
                 pages_->showResults(results_);
               });
  }
  refresh();
}

void LearningPanel::begin(Doing doing, const QString& words) {
  doing_ = doing;
  said_.clear();
  failed_.clear();
  beginProgress(words);
}

void LearningPanel::onEnded() {
  if (read_again_) return read();
  refresh();
}

void LearningPanel::trainOrCancel() {
  if (busy())
    cancel();
  else if (results_.stages)
    train();
  else
    read();
}

void LearningPanel::train() {
  if (!ready()) return;
  begin(Doing::kTraining, tr("training"));
  job_.start([stages = results_.stages, settings = settings_](
                 base::Progress& progress) { return trainCorrection(*stages, settings, progress); },
             [this](TrainedCorrection trained) {
               results_.evaluation = std::make_shared<const HeldOutEvaluation>(std::move(trained.evaluation));
               results_.learned =
                   std::make_shared<const learning::LearningReport>(std::move(trained.learned));
               pages_->showResults(results_);
             });
  refresh();
}

void LearningPanel::runAblation() {
  if (!ready()) return;
  pages_->setCurrentWidget(&pages_->ablation());
  begin(Doing::kAblation, tr("ablation"));
  const int splits = pages_->ablation().splits();
  job_.start([stages = results_.stages, options = settings_.study(splits)](
                 base::Progress& progress) { return correctionStudy(stages->states, options, &progress); },
             [this, splits](CorrectionStudyReport study) {
               results_.study = std::make_shared<const CorrectionStudyReport>(std::move(study));
               results_.splits = splits;
               pages_->showResults(results_);
             });
  refresh();
}

void LearningPanel::runCurve() {
  if (!ready()) return;
  pages_->setCurrentWidget(&pages_->curve());
  begin(Doing::kCurve, tr("learning curve"));
  job_.start([stages = results_.stages, options = settings_.curve()](
                 base::Progress& progress) { return learningCurve(stages->states, options, &progress); },
             [this](LearningCurve curve) {
               results_.curve = std::make_shared<const LearningCurve>(std::move(curve));
               pages_->showResults(results_);
             });
  refresh();
}

void LearningPanel::cancel() {
  if (export_.busy()) return export_.cancel();
  if (!job_.busy()) return;
  said_ = results_.stages ? tr("Cancelled; the results shown are from before.") : tr("Cancelled.");
  job_.cancel();
  refresh();
}

void LearningPanel::askFolder() {
  auto* dialog = new QFileDialog(this, tr("Folder for figures and tables"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, &LearningPanel::exportTo);
  dialog->open();
}

void LearningPanel::exportTo(const QString& folder) {
  if (!ready()) return;
  QImage clouds;
  if (CloudView::available()) {
    pages_->clouds().view().image();
    clouds = pages_->clouds().view().grab().toImage();
  }
  begin(doing_, tr("export"));
  export_.start(results_, pages_->trajectories().chosen(), pages_->confidence().slice(), clouds, folder);
  refresh();
}

void LearningPanel::askModel() {
  auto* dialog = new QFileDialog(this, tr("Save the correction"), "arm.correction",
                                 tr("Corrections (*.correction);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("correction");
  connect(dialog, &QFileDialog::fileSelected, this, &LearningPanel::saveModel);
  dialog->open();
}

void LearningPanel::saveModel(const QString& path) {
  if (!results_.learned) return;
  try {
    learning::writeCorrection({results_.learned->model, source()}, path.toStdString());
    said_ = tr("Saved as %1.").arg(path);
    Q_EMIT modelSaved(path);
  } catch (const base::InputError& error) {
    said_ = QString::fromStdString(error.what());
  }
  refresh();
}

learning::CorrectionSource LearningPanel::source() const {
  std::vector<std::string> tables;
  for (const QString& table : choice().tables) tables.push_back(table.toStdString());
  return learning::correctionSource(tables, results_.stages->towards, *results_.learned, base::software());
}

QString LearningPanel::failedHeadline() const {
  switch (doing_) {
    case Doing::kTraining:
      return tr("Not trained");
    case Doing::kAblation:
      return tr("No ablation table");
    case Doing::kCurve:
      return tr("No learning curve");
    default:
      return tr("Not read");
  }
}

void LearningPanel::showState() {
  const LearningStages* stages = results_.stages.get();
  QString head, below;
  if (!failed_.isEmpty()) {
    head = failedHeadline();
    below = failed_;
  } else if (results_.evaluation) {
    head = tr("● Corrected: %1").arg(errorWords(*results_.evaluation, true));
    below = tr("Observed → rigid offset → corrected: medians on %1 of %2 trajectories, held out of training. "
               "Learned from %3.")
                .arg(results_.evaluation->motions_held)
                .arg(results_.evaluation->motions)
                .arg(motionWords(results_.learned->model.motion()));
  } else if (stages) {
    head = tr("○ %1 of %2 states accepted; with a rigid offset %3\u00a0mm,\u00a0%4°")
               .arg(countText(stages->cleaning.kept()), countText(stages->states.size()))
               .arg(base::toMillimetres(stages->after.median_distance), 0, 'f', 1)
               .arg(base::toDegrees(stages->after.median_angle), 0, 'f', 1);
    below = job_.busy() ? tr("This may take some minutes; Esc cancels it.")
                        : tr("Press Train (F5) to learn the remaining error.");
  } else if (job_.busy()) {
    head = tr("Reading…");
    below = tr("Screening, pairing, cleaning; Esc cancels it.");
  } else if (choice().tables.isEmpty()) {
    head = tr("How far from its command does the arm arrive?");
    below =
        tr("Choose one or more tables of tip poses: observed poses beside commanded ones, over some tens of "
           "trajectories. A correction of the commands is learned from them, and evaluated on held-out "
           "trajectories.");
  } else {
    head = tr("Not read yet");
    below = tr("Press Read (F5).");
  }
  showHead(head, below, stages != nullptr);
}

void LearningPanel::refresh() {
  showState();
  showWords(said_);
  const bool working = busy();
  showProgress(working);
  train_->setText(working                                        ? tr("Cancel")
                  : results_.stages || choice().tables.isEmpty() ? tr("Train")
                                                                 : tr("Read"));
  train_->setToolTip(
      working ? tr("Stop the computation (Esc)")
              : tr("Evaluate on a held-out fifth of the trajectories, and learn a correction from all (F5)"));
  train_->setEnabled(working || !choice().tables.isEmpty());
  pages_->ablation().setReady(ready());
  pages_->curve().setReady(ready());
  export_button_->setVisible(results_.stages && !working);
  model_button_->setVisible(results_.evaluation && !working);
}

}  // namespace capstan::widgets
