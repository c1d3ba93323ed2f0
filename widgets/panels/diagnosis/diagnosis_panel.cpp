#include "widgets/panels/diagnosis/diagnosis_panel.h"

#include <QBoxLayout>
#include <QFileDialog>
#include <QFileInfo>
#include <QPushButton>
#include <QSplitter>

#include "core/base/error.h"
#include "widgets/panels/diagnosis/cause_tree.h"
#include "widgets/panels/diagnosis/diagnosis_headline.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/effort_box.h"
#include "widgets/panels/diagnosis/hypothesis_card.h"
#include "widgets/panels/diagnosis/ranking_table.h"
#include "widgets/panels/diagnosis/recording_picker.h"
#include "widgets/panels/diagnosis/report_files.h"
#include "widgets/panels/diagnosis/report_pages.h"
#include "widgets/panels/diagnosis/tolerance_edit.h"
#include "widgets/panels/work/folder_dialog.h"

namespace capstan::widgets {

using diagnosis::Report;

namespace {

constexpr int kCauseShare = 30;  ///< share of the height for the causes, the rest for the figures [%]

}  // namespace

DiagnosisPanel::DiagnosisPanel(DiagnosisRun run, QWidget* parent) : WorkPanel(parent), run_(std::move(run)) {
  makeButtons();
  addHead(makeInput(), diagnose_, tr("verdict"));
  addBody(makeBody());
  addFoot({save_, use_, page_}, tr("state of the diagnosis"));
  connect(picker_, &RecordingPicker::changed, this, &DiagnosisPanel::onInput);
  connect(tolerance_, &ToleranceEdit::changed, this, &DiagnosisPanel::onInput);
  connect(effort_, &EffortBox::changed, this, &DiagnosisPanel::onInput);
  connect(causes_, &CauseTree::chosenChanged, this, &DiagnosisPanel::onCause);
  connect(pages_, &ReportPages::candidateChosen, this, &DiagnosisPanel::onCandidate);
  connect(pages_, &ReportPages::currentChanged, this, &DiagnosisPanel::showCard);
  connect(&job_, &Job::failed, this, [this](const QString& why) { failed_ = why; });
  connect(&job_, &Job::ended, this, &DiagnosisPanel::refresh);
  connect(&job_, &Job::progressed, this, &DiagnosisPanel::onProgress);
  connect(&export_, &ReportExport::progressed, this, &DiagnosisPanel::onProgress);
  connect(&export_, &ReportExport::ended, this, [this](const QString& index, const QString& words) {
    said_ = words;
    if (!index.isEmpty()) Q_EMIT exported(index);
    refresh();
  });
  setTheme(theme_);
  refresh();
}

DiagnosisPanel::~DiagnosisPanel() = default;

QWidget* DiagnosisPanel::makeInput() {
  auto* input = new QWidget;
  auto* rows = new QVBoxLayout(input);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(4);
  rows->addWidget(picker_ = new RecordingPicker);
  auto* line = new QHBoxLayout;
  line->setSpacing(10);
  line->addWidget(tolerance_ = new ToleranceEdit, 1);
  line->addWidget(effort_ = new EffortBox, 0, Qt::AlignTop);
  rows->addLayout(line);
  return input;
}

QWidget* DiagnosisPanel::makeBody() {
  split_ = new QSplitter(Qt::Vertical);
  split_->setChildrenCollapsible(false);
  top_ = new QSplitter(Qt::Horizontal);
  top_->setChildrenCollapsible(false);
  top_->addWidget(causes_ = new CauseTree);
  top_->addWidget(card_ = new HypothesisCard);
  split_->addWidget(top_);
  split_->addWidget(pages_ = new ReportPages);
  connect(split_, &QSplitter::splitterMoved, this, [this] { user_split_ = true; });
  return split_;
}

void DiagnosisPanel::makeButtons() {
  diagnose_ = button("diagnose_now", tr("Diagnose"), QString(), [this] { diagnoseOrCancel(); });
  save_ = button("save_extended", tr("Save extended robot…"),
                 tr("The robot with the refit and the causes found, as a robot file (Ctrl+Shift+S)"),
                 [this] { askFile(); });
  use_ = button("use_extended", tr("Use this robot"), QString(), [this] { useRobot(); });
  next_ = button("save_next", tr("Save next experiment…"),
                 tr("The proposed motion as a trajectory that a simulated session takes (Ctrl+Shift+N)"),
                 [this] { askTrajectory(); });
  page_ = button("export_report", tr("Export report…"),
                 tr("A page with all figures, the report as JSON and the robot file (Ctrl+Shift+E)"),
                 [this] { askFolder(); });
  addKey("Ctrl+Shift+S", save_);
  addKey("Ctrl+Shift+Return", use_);
  addKey("Ctrl+Shift+N", next_);
  addKey("Ctrl+Shift+E", page_);
}

void DiagnosisPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  picker_->setTheme(theme);
  tolerance_->setTheme(theme);
  causes_->setTheme(theme);
  card_->setTheme(theme);
  pages_->setTheme(theme);
  styleWords(theme);
}

void DiagnosisPanel::offer(const QString& path, const QString& words, const QString& read_as) {
  picker_->offer(path, words, read_as);
}

void DiagnosisPanel::preselect(const QString& path, const QString& robot, const QString& read_as) {
  DiagnosisChoice chosen = choice();
  if (busy() || report() || chosen.recordings != preselected_) return;
  chosen.recordings.clear();
  chosen.add({path});
  chosen.robot = robot;
  chosen.read_as = read_as;
  preselected_ = chosen.recordings;
  choose(chosen);
}

void DiagnosisPanel::setSession(const RunningSession& session) {
  session_ = session;
  refresh();
}

void DiagnosisPanel::save(QSettings& settings) const { choice().save(settings); }

void DiagnosisPanel::restore(const QSettings& settings) { choose(DiagnosisChoice::restore(settings)); }

void DiagnosisPanel::choose(const DiagnosisChoice& choice) {
  picker_->setChoice(choice);
  tolerance_->setText(choice.material);
  effort_->setEffort(choice.effort);
  onInput();
}

/// Recordings, units and robot of the picker, and tolerance and effort of the line below it.
DiagnosisChoice DiagnosisPanel::choice() const {
  DiagnosisChoice choice = picker_->choice();
  choice.material = tolerance_->text();
  choice.effort = effort_->effort();
  return choice;
}

void DiagnosisPanel::onInput() {
  said_.clear();
  failed_.clear();
  refresh();
}

/// Which recordings the report is of, and which other one the window shows.
QString DiagnosisPanel::ofWords() const {
  const QString diagnosed = fileNamesOf(of_.recordings);
  const QFileInfo open(session_.recording);
  return session_.recording.isEmpty() || of_.recordings.contains(open.absoluteFilePath())
             ? tr("Of %1.").arg(diagnosed)
             : tr("Of %1; the window shows %2.").arg(diagnosed, open.fileName());
}

bool DiagnosisPanel::canDiagnose() const {
  return !choice().recordings.isEmpty() && tolerance_->error().isEmpty();
}

void DiagnosisPanel::diagnoseOrCancel() { busy() ? cancel() : diagnose(); }

void DiagnosisPanel::diagnose() {
  if (busy() || !canDiagnose()) return;
  said_.clear();
  failed_.clear();
  beginProgress(tr("reading"));
  job_.start([run = run_, choice = choice()](base::Progress& progress) { return run(choice, progress); },
             [this, of = choice()](Report report) {
               showReport(std::move(report));
               of_ = of;
               refresh();
             });
  refresh();
}

void DiagnosisPanel::cancel() {
  if (export_.busy()) return export_.cancel();
  if (!job_.busy()) return;
  said_ = report() ? tr("Cancelled; the results shown are of the previous run.") : tr("Cancelled.");
  job_.cancel();
  refresh();
}

void DiagnosisPanel::showReport(Report report) {
  report_ = std::make_shared<const Report>(std::move(report));
  of_ = choice();
  causes_->showReport(*report_);
  pages_->showReport(report_);
  onCause();
  refresh();
}

/// Shows the description of the selected cause, and the channel whose residual falls most with it.
void DiagnosisPanel::onCause() {
  if (!report_) return;
  const diagnosis::Cause* cause = causes_->chosen();
  pages_->showChannel(cause ? cause->gain.channel : channelWorthSeeing(*report_));
  showCard();
}

/// Shows the description of the selected cause; without one, of the residual.
void DiagnosisPanel::showCard() {
  if (!report_) return;
  const diagnosis::Cause* cause = causes_->chosen();
  if (!cause) return card_->showRemains(*report_);
  card_->showEffect(cause->effect, placeOf(cause->effect, cause->joint, report_->extended));
}

void DiagnosisPanel::onCandidate() {
  const diagnosis::Candidate* candidate = pages_->ranking().chosen();
  if (candidate)
    card_->showEffect(candidate->effect, placeOf(candidate->effect, candidate->joint, report_->extended),
                      tr("A candidate of the ranking."));
}

void DiagnosisPanel::useRobot() {
  if (!report()) return;
  const QString of =
      of_.recordings.isEmpty() ? QString() : tr(" (diagnosed: %1)").arg(fileNamesOf(of_.recordings));
  Q_EMIT robotChosen(report_->extended,
                     tr("extended robot in use, errors restarted: %1%2").arg(headlineOf(*report_), of));
  said_ = tr("The running session uses the extended robot; its errors restart.");
  refresh();
}

void DiagnosisPanel::askFile() {
  auto* dialog = new QFileDialog(this, tr("Save the extended robot"), "extended.yaml",
                                 tr("Robot files (*.yaml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("yaml");
  connect(dialog, &QFileDialog::fileSelected, this, &DiagnosisPanel::saveRobot);
  dialog->open();
}

void DiagnosisPanel::saveRobot(const QString& path) {
  if (!report()) return;
  const bool saved = saveExtendedRobot(*report_, path, said_);
  if (saved) Q_EMIT robotSaved(path);
  refresh();
}

void DiagnosisPanel::askTrajectory() {
  auto* dialog = new QFileDialog(this, tr("Save the trajectory of the next experiment"),
                                 "next-experiment.csv", tr("Trajectories (*.csv);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("csv");
  connect(dialog, &QFileDialog::fileSelected, this, &DiagnosisPanel::saveTrajectory);
  dialog->open();
}

void DiagnosisPanel::saveTrajectory(const QString& path) {
  if (!report() || !report_->next) return;
  saveNextExperiment(*report_->next, path, said_);
  refresh();
}

void DiagnosisPanel::askFolder() {
  auto* dialog = new FolderDialog(this, tr("Folder for the page with all figures"));
  connect(dialog, &QFileDialog::fileSelected, this, &DiagnosisPanel::exportTo);
  dialog->open();
}

void DiagnosisPanel::exportTo(const QString& folder) {
  if (!report() || busy()) return;
  said_.clear();
  try {
    export_.start(*report_, report_->extended.name, folder);
  } catch (const base::InputError& error) {
    said_ = QString::fromStdString(error.what());
  }
  refresh();
}

void DiagnosisPanel::showVerdict() {
  const Report* shown = job_.busy() ? nullptr : report();
  const Headline head = shown                            ? verdictOf(*shown)
                        : job_.busy()                    ? searchingHeadline()
                        : !failed_.isEmpty()             ? Headline{tr("Not diagnosed"), failed_}
                        : choice().recordings.isEmpty()  ? emptyHeadline()
                        : !tolerance_->error().isEmpty() ? toleranceHeadline()
                                                         : readyHeadline();
  showHead(head.head, head.below, shown != nullptr);
}

void DiagnosisPanel::refresh() {
  showVerdict();
  QStringList lines;
  if (!said_.isEmpty()) lines << said_;
  const Report* shown = job_.busy() ? nullptr : report();
  if (shown && said_.isEmpty()) {
    if (!of_.recordings.isEmpty()) lines << ofWords();
    for (const std::string& notice : shown->notices) lines << QString::fromStdString(notice);
  }
  const QString all = lines.join('\n');
  constexpr int kMostLines = 2;
  if (lines.size() > kMostLines) {
    const auto more = lines.size() - kMostLines + 1;
    lines = lines.mid(0, kMostLines - 1) << tr("… and %1 more remarks").arg(more);
  }
  showWords(lines.join('\n'), all);
  const bool working = busy();
  showProgress(working);
  diagnose_->setText(working ? tr("Cancel") : tr("Diagnose"));
  diagnose_->setToolTip(working ? tr("Stop the computation (Esc)")
                                : tr("Find where the robot model is wrong, and why (F5)"));
  diagnose_->setEnabled(working || canDiagnose());
  for (QPushButton* one : {save_, use_, page_}) one->setVisible(shown != nullptr && !working);
  next_->setVisible(shown != nullptr && !working && shown->next);
  const UseOffer offer = shown ? useOffer(*shown, of_, session_) : UseOffer{false, tr("Use this robot"), {}};
  use_->setText(offer.words);
  use_->setToolTip(offer.tip);
  use_->setEnabled(offer.enabled);
}

void DiagnosisPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  if (user_split_) return;
  const int top = kCauseShare * split_->height() / 100;
  split_->setSizes({top, split_->height() - top});
  top_->setSizes({top_->width() * 11 / 20, top_->width() * 9 / 20});
}

}  // namespace capstan::widgets
