#include "widgets/shell/compare_controller.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QSplitter>

#include <cmath>
#include <limits>

#include "core/live/corrected_source.h"
#include "core/live/plotted_steps.h"
#include "core/recording/session_file.h"
#include "widgets/figures/joint_errors.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/figures/linked_figures.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/rerun_dialog.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

namespace {

constexpr double kNoOffset = 5e-4;  // [s]

std::shared_ptr<SecondRun> track(tracking::Source& source, const tracking::SourceInfo& info,
                                 const analysis::RerunChange& change, double until,
                                 base::Progress& progress) {
  auto run = std::make_shared<SecondRun>();
  for (std::size_t i = 0; i < 3 && i < info.robot.joints.size(); ++i)
    run->joint_names[i] = QString::fromStdString(info.robot.joints[i].name);
  live::PlottedSteps plotted(live::RunnerOptions::kHistoryRate);
  const auto take = [&](const tracking::Snapshot& snapshot) {
    if (snapshot.motor_updated) run->motion.add(snapshot);
    if (!plotted.take(snapshot)) return;
    run->values.append(snapshot);
    appendErrors(run->errors, snapshot);
  };
  run->report = analysis::rerun(source, info, change, progress, take, until);
  return run;
}

/// "in the session", and since when the report covers it.
QString inTheSession(const tracking::TrackReport& report) {
  return report.since == tracking::ReportStart::kBeginning
             ? CompareController::tr("in the session")
             : CompareController::tr("in the session since %1")
                   .arg(QString::fromStdString(std::string(base::nameOf(report.since))));
}

/// UKF errors as "0.210°, 0.104°, 0.30 mm"; empty without a reference.
QString errorsText(const tracking::TrackReport& report) {
  if (report.errors.ukf().count() == 0) return {};
  const Eigen::Vector3d rms = report.errors.ukf().value();
  return QStringLiteral("%1°, %2°, %3 mm")
      .arg(tracking::forPeople(rms(0), 0), 0, 'f', 3)
      .arg(tracking::forPeople(rms(1), 1), 0, 'f', 3)
      .arg(tracking::forPeople(rms(2), 2), 0, 'f', 3);
}

}  // namespace

CompareController::CompareController(const Views& views, SessionLink& link, QObject* parent)
    : QObject(parent), views_(views), link_(link) {
  rerun_ = addAction("rerunWith", tr("Re-run with…"), "Ctrl+B");
  compare_ = addAction("compareWith", tr("Compare with a recording…"), "Ctrl+Shift+B");
  end_ = addAction("endComparison", tr("End the comparison"), "Ctrl+Alt+B");
  connect(rerun_, &QAction::triggered, this, &CompareController::askRerun);
  connect(compare_, &QAction::triggered, this, &CompareController::askFile);
  connect(end_, &QAction::triggered, this, &CompareController::end);
  end_->setEnabled(false);
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo&, const SourceChoice& choice) {
    end();
    choice_ = choice;
    motion_ = {};
  });
  connect(&link, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const tracking::Snapshot& snapshot : snapshots) motion_.add(snapshot);
  });
  connect(&job_, &Job::progressed, this, [this](double fraction, const QString&) {
    views_.news.setText(tr("Tracking the second run: %1 %").arg(qRound(100.0 * fraction)));
  });
  connect(&job_, &Job::failed, this, [this](const QString& why) { views_.news.showMessage(why); });
}

CompareController::~CompareController() = default;

QAction* CompareController::addAction(const char* name, const QString& text, const QString& key) {
  auto& window = *qobject_cast<QWidget*>(parent());
  auto* action = new QAction(text, &window);
  action->setObjectName(name);
  action->setShortcut(QKeySequence(key));
  window.addAction(action);
  return action;
}

void CompareController::askRerun() {
  auto* dialog = new RerunDialog(qobject_cast<QWidget*>(parent()));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &RerunDialog::chosen, this, &CompareController::rerun);
  dialog->open();
}

void CompareController::askFile() {
  auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()), tr("Compare with a recording"), {},
                                 tr("Recordings (*.capstan *.csv *.jsonl *.h5 *.mat *.bag);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, &CompareController::compareWith);
  dialog->open();
}

void CompareController::start(std::function<std::shared_ptr<SecondRun>(base::Progress&)> work,
                              std::function<void()> show) {
  end();
  views_.news.showNews(tr("Tracking the second run…"), {{tr("Cancel"), [this] {
                                                           job_.cancel();
                                                           views_.news.hide();
                                                         }}});
  job_.start(std::move(work), [this, show = std::move(show)](const std::shared_ptr<SecondRun>& run) {
    second_ = run;
    end_->setEnabled(true);
    show();
  });
}

void CompareController::rerun(const analysis::RerunChange& change) {
  if (!link_.runner() || busy()) return;
  if (!choice_.live.isEmpty() || (!choice_.simulated && choice_.file.isEmpty()))
    return views_.news.showMessage(
        tr("A live session cannot be tracked again. Record it, and open the recording."));
  if (change.empty())
    return views_.news.showMessage(tr("Nothing is changed. Choose what is to be different."));
  const double until = link_.runner()->status().t;
  start(
      [choice = choice_, change, until, info = link_.runner()->infoInUse(),
       images = link_.runner()->images()](base::Progress& progress) {
        const auto source = openSource(choice);
        live::CorrectedSource corrected(*source, images);
        auto run = track(corrected, info, change, until, progress);
        run->words = QString::fromStdString(change.words());
        return run;
      },
      [this] { showOver(); });
}

void CompareController::compareWith(const QString& file) {
  if (!link_.runner() || busy()) return;
  start(
      [file](base::Progress& progress) {
        const auto source = openSource(SourceChoice::ofFile(file));
        auto run = track(*source, source->info(), {}, std::numeric_limits<double>::infinity(), progress);
        run->words = QFileInfo(file).fileName();
        return run;
      },
      [this] { showBeside(); });
}

void CompareController::showOver() {
  views_.figure.setSecond(second_->values, second_->errors);
  const auto report = link_.runner()->report();
  const QString first = errorsText(report), second = errorsText(second_->report);
  say(second.isEmpty() ? tr("Dashed: UKF with %1.").arg(second_->words)
                       : tr("Dashed: UKF with %1. RMS errors %2; %3 %4.")
                             .arg(second_->words, second, inTheSession(report), first));
}

void CompareController::showBeside() {
  second_figure_ = new JointFigure(second_->values);
  second_figure_->setErrors(second_->errors);
  setTheme(theme_);
  second_figure_->setJointNames(second_->joint_names);
  second_figure_->setFollowing(false);
  views_.plots.addWidget(second_figure_);
  views_.plots.setSizes({1000, 1000});
  const auto aligned = analysis::alignmentOf(motion_, second_->motion);
  const bool same = aligned && aligned->same();
  const double offset = same ? aligned->offset : second_->values.begin() - views_.figure.history().begin();
  linked_ = std::make_unique<LinkedFigures>(views_.figure, *second_figure_, offset);
  QString words = tr("Right: %1. ").arg(second_->words);
  if (!same)
    words += tr("The motions differ: both begin together.");
  else if (std::abs(offset) < kNoOffset)
    words += tr("Aligned by the motion: no offset (correlation %1).").arg(aligned->correlation, 0, 'f', 2);
  else
    words += tr("Aligned by the motion: its time is %1 s %2 (correlation %3).")
                 .arg(std::abs(offset), 0, 'f', 3)
                 .arg(offset > 0.0 ? tr("ahead") : tr("behind"))
                 .arg(aligned->correlation, 0, 'f', 2);
  if (same && !aligned->clear()) words += tr(" The motion repeats: other offsets fit nearly as well.");
  const QString errors = errorsText(second_->report);
  const auto report = link_.runner()->report();
  if (!errors.isEmpty())
    words += tr(" UKF errors %1; %2 %3.").arg(errors, inTheSession(report), errorsText(report));
  say(words);
}

void CompareController::setTheme(const Theme& theme) {
  theme_ = theme;
  if (second_figure_) second_figure_->setTheme(theme.isDark() ? Theme::dark() : Theme::light());
}

void CompareController::say(const QString& words) {
  views_.news.showNews(words, {{tr("End the comparison"), [this] { end(); }}});
}

void CompareController::end() {
  linked_.reset();
  views_.figure.clearSecond();
  delete second_figure_;
  second_figure_ = nullptr;
  second_.reset();
  end_->setEnabled(false);
  views_.news.hide();
}

}  // namespace capstan::widgets
