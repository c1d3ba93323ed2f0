#include "widgets/panels/experiments/experiments_panel.h"

#include <QFileDialog>
#include <QPushButton>
#include <QSettings>
#include <QSplitter>
#include <QTextBrowser>

#include "core/base/error.h"
#include "core/base/software.h"
#include "widgets/figures/correction_experiment_figures.h"
#include "widgets/panels/experiments/experiment_picker.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

using namespace experiments;

ExperimentsPanel::ExperimentsPanel(CorrectionExperimentOptions options, QWidget* parent)
    : WorkPanel(parent), options_(std::move(options)) {
  run_ = button("run_experiment", tr("Run"), tr("Run the experiment (F5)"), [this] { runOrCancel(); });
  export_ = button("export_experiment", tr("Export…"),
                   tr("Comparison, tables, figure and numbers, into a folder (Ctrl+Shift+E)"),
                   [this] { askFolder(); });
  addKey("Ctrl+Shift+E", export_);
  addHead(picker_ = new ExperimentPicker, run_, tr("result of the experiment"));
  body_ = new QSplitter(Qt::Vertical);
  body_->setChildrenCollapsible(false);
  body_->addWidget(figure_ = new FigureSheet);
  body_->addWidget(comparison_ = new QTextBrowser);
  comparison_->setObjectName("experiment_comparison");
  comparison_->setOpenExternalLinks(true);
  comparison_->setWordWrapMode(QTextOption::WordWrap);  // wide tables scroll, words stay whole
  addBody(body_);
  addFoot({export_}, tr("state of the experiment"));
  connect(picker_, &ExperimentPicker::changed, this, &ExperimentsPanel::refresh);
  connect(&job_, &Job::progressed, this, &ExperimentsPanel::onProgress);
  connect(&job_, &Job::failed, this, [this](const QString& why) { said_ = why; });
  connect(&job_, &Job::ended, this, &ExperimentsPanel::refresh);
  refresh();
}

ExperimentsPanel::~ExperimentsPanel() = default;

void ExperimentsPanel::setTheme(const Theme& theme) {
  picker_->setTheme(theme);
  figure_->setTheme(theme);
  styleWords(theme);
}

void ExperimentsPanel::save(QSettings& settings) const {
  settings.setValue("experiments/tables", picker_->tables());
  settings.setValue("experiments/which", static_cast<int>(picker_->experiment()));
  settings.setValue("experiments/towards",
                    picker_->towards() == learning::StreamKind::kCommand ? "command" : "robot");
}

void ExperimentsPanel::restore(const QSettings& settings) {
  const int which = settings.value("experiments/which").toInt();
  if (which >= 0 && which <= static_cast<int>(CorrectionExperiment::kDebridement))
    picker_->choose(static_cast<CorrectionExperiment>(which));
  picker_->setTowards(settings.value("experiments/towards").toString() == QLatin1String("robot")
                          ? learning::StreamKind::kRobot
                          : learning::StreamKind::kCommand);
  picker_->setTables(settings.value("experiments/tables").toStringList());
}

void ExperimentsPanel::runOrCancel() {
  if (busy()) return cancel();
  if (!picker_->complete()) return picker_->askFiles();
  CorrectionExperimentOptions options = options_;
  options.experiment = picker_->experiment();
  options.towards = picker_->towards();
  if (needsPoses(options.experiment))
    for (const QString& table : picker_->tables()) options.poses.push_back(table.toStdString());
  results_.reset();
  said_.clear();
  beginProgress(tr("starting"));
  job_.start([options](base::Progress& progress) { return runCorrectionExperiment(options, progress); },
             [this](CorrectionExperimentResults results) { take(std::move(results)); });
  refresh();
}

void ExperimentsPanel::cancel() {
  if (!busy()) return;
  job_.cancel();
  said_ = tr("Cancelled.");
}

void ExperimentsPanel::take(CorrectionExperimentResults results) {
  if (results.cancelled) return;
  results_ = std::make_unique<CorrectionExperimentResults>(std::move(results));
  figure_->setFigure(figureOf(*results_));
  const QString page = QString::fromStdString(comparisonPage(*results_, base::software()));
  title_ = page.section(QLatin1Char('\n'), 0, 0).mid(2);  // without "# "
  comparison_->setMarkdown(page.section(QLatin1Char('\n'), 1));
}

void ExperimentsPanel::askFolder() {
  auto* dialog = new QFileDialog(this, tr("Export the experiment into a folder"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, &ExperimentsPanel::exportTo);
  dialog->open();
}

void ExperimentsPanel::exportTo(const QString& folder) {
  if (!results_) return;
  try {
    writeExperiment(*results_, folder.toStdString());
    said_ = tr("Exported to %1.").arg(folder);
    Q_EMIT exported(folder);
  } catch (const base::InputError& error) {
    said_ = QString::fromStdString(error.what());
  }
  refresh();
}

void ExperimentsPanel::refresh() {
  run_->setText(busy() ? tr("Cancel") : tr("Run"));
  export_->setEnabled(results_ && !busy());
  showProgress(busy());
  if (results_)
    showHead(title_, {}, true);
  else
    showHead(busy() ? tr("Running experiment %1").arg(QChar('E' + static_cast<int>(picker_->experiment())))
                    : tr("Nothing run yet"),
             picker_->complete()
                 ? tr("Press Run (F5). The results stand beside the paper's numbers.")
                 : tr("Choose tables of tip poses first: observed poses beside commanded ones."),
             false);
  showWords(said_);
}

}  // namespace capstan::widgets
