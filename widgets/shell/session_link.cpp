#include "widgets/shell/session_link.h"

#include <QDateTime>
#include <QDir>
#include <chrono>
#include <exception>
#include <utility>

#include "core/base/error.h"
#include "core/live/recorder_options.h"
#include "core/recording/disk_space.h"
#include "core/recording/recover.h"
#include "core/recording/session_file.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::widgets {

namespace {

constexpr int kPeriod = 33;       ///< [ms]
constexpr int kFramePeriod = 4;   ///< of looking for new images [ms]
constexpr int kReportTicks = 10;  ///< ticks per update of the error table: three per second

std::unique_ptr<live::Runner> makeRunner(std::unique_ptr<tracking::Source> source) {
  auto pipeline = tracking::makePipeline(source->info());
  return std::make_unique<live::Runner>(std::move(source), std::move(pipeline));
}

bool isRecording(const live::Runner& runner) {
  const auto recorder = runner.recorder();
  return recorder && recorder->stats().state == recording::RecorderState::kRecording;
}

/// Error or gaps of a recording; empty if it is whole.
std::string faultOf(const recording::RecorderStats& stats) {
  if (!stats.error.empty()) return stats.error;
  return stats.dropped > 0 ? recording::gapsText(stats.dropped) : std::string();
}

}  // namespace

SessionLink::SessionLink(QObject* parent) : QObject(parent) {
  connect(&timer_, &QTimer::timeout, this, &SessionLink::tick);
  timer_.start(kPeriod);
  frames_timer_.setTimerType(Qt::PreciseTimer);
  connect(&frames_timer_, &QTimer::timeout, this, &SessionLink::lookForFrames);
  frames_timer_.start(kFramePeriod);
}

SessionLink::~SessionLink() = default;

void SessionLink::open(const SourceChoice& choice) {
  if (opening())
    waiting_ = choice;
  else
    beginOpening(choice);
}

void SessionLink::beginOpening(const SourceChoice& choice) {
  choice_ = choice;
  opening_ = std::async(std::launch::async, [choice] { return makeRunner(openSource(choice)); });
}

void SessionLink::take(std::unique_ptr<tracking::Source> source) {
  begin(makeRunner(std::move(source)), std::nullopt);
}

void SessionLink::begin(std::unique_ptr<live::Runner> runner, const std::optional<SourceChoice>& choice) {
  again_ = runner_ && choice && choice == running_by_;
  running_by_ = choice;
  const bool recorded = std::exchange(reported_recording_, false) || recording();
  retire(std::move(runner_), recorded);
  runner_ = std::move(runner);
  frame_ = {};
  listeners_.clear();
  last_state_ = live::RunState::kPaused;
  command_faults_ = 0;
  if (const auto* chosen = robots_.robotFor(runner_->info()))
    runner_->setRobot(*chosen, robots_.summary().toStdString());
  Q_EMIT opened(runner_->info(), choice.value_or(SourceChoice{}));
}

bool SessionLink::useRobot(const robot::Description& robot, const RobotWords& words) {
  if (!runner_) return false;
  try {
    runner_->setRobot(robot, words.summary.toStdString());
  } catch (const base::InputError& error) {
    Q_EMIT failed(QString::fromStdString(error.what()));
    return false;
  }
  robots_.choose(runner_->info(), robot, words);
  Q_EMIT robotChanged();
  return true;
}

/// Ends a runner in the background. `report_recording`: status() has not reported the end of its recording;
/// hearRetired() then reports an error or gaps.
void SessionLink::retire(std::unique_ptr<live::Runner> runner, bool report_recording) {
  if (!runner) return;
  retiring_.push_back(std::async(std::launch::async, [old = std::move(runner), report_recording]() mutable {
    const auto recorder = old->recorder();
    old.reset();
    return report_recording ? faultOf(recorder->stats()) : std::string();
  }));
}

void SessionLink::hearRetired() {
  std::vector<std::string> faults;
  std::erase_if(retiring_, [&](auto& one) {
    if (one.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    faults.push_back(one.get());
    return true;
  });
  for (const std::string& fault : faults)
    if (!fault.empty())
      Q_EMIT failed(tr("Recording of the previous session: %1").arg(QString::fromStdString(fault)));
}

void SessionLink::finishOpening() {
  try {
    auto runner = opening_.get();
    if (waiting_)
      retire(std::move(runner), false);  // it has not run
    else
      begin(std::move(runner), choice_);
  } catch (const recording::ImplausibleUnits& refused) {
    if (!waiting_) Q_EMIT unitsAsked(refused, choice_);
  } catch (const base::InputError& error) {
    if (!waiting_) refuse(error);
  } catch (const std::exception& error) {
    if (!waiting_) Q_EMIT failed(QString::fromStdString(error.what()));
  }
  if (waiting_ && !opening()) beginOpening(*std::exchange(waiting_, std::nullopt));
}

void SessionLink::refuse(const base::InputError& error) {
  Q_EMIT failed(QString::fromStdString(error.what()));
  if (recording::isRecoverable(error)) offerRecovery(error.fault().file);
}

void SessionLink::offerRecovery(const std::string& file) {
  Q_EMIT damaged(QString::fromStdString(file), tr("What is readable can be saved into a new session"));
}

void SessionLink::listen(const QObject* who, live::Listener listener) {
  if (listener)
    listeners_[who] = std::move(listener);
  else
    listeners_.erase(who);
  if (!runner_) return;
  if (listeners_.empty()) return runner_->listen({});
  std::vector<live::Listener> all;
  for (const auto& [one, hears] : listeners_) all.push_back(hears);
  runner_->listen({[all](const tracking::TrackingPipeline& pipeline) {
                     for (const auto& one : all)
                       if (one.begin) one.begin(pipeline);
                   },
                   [all](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                     for (const auto& one : all) one.take(sample, snapshot);
                   }});
}

void SessionLink::setRunning(bool on) {
  if (!runner_) return;
  if (on)
    runner_->run();
  else
    runner_->pause();
}

bool SessionLink::recording() const { return runner_ && isRecording(*runner_); }

void SessionLink::toggleRecording(const QString& folder) {
  if (!runner_) return;
  if (recording()) {
    runner_->stopRecording();
    return;
  }
  const QDateTime now = QDateTime::currentDateTime();
  const QString file = QDir(folder).filePath(now.toString("yyyy-MM-dd_HHmmss") + recording::kSessionSuffix);
  try {
    recording::checkRecordingFolder(folder.toStdString());
    QDir().mkpath(folder);
    runner_->startRecording(file.toStdString(),
                            recording::headerOf(runner_->info(), now.toString(Qt::ISODate).toStdString()),
                            live::recorderOptionsFor(runner_->info(), runner_->status()));
    emitStatus(runner_->status());  // a recording that fails at once has been shown, and its end is reported
  } catch (const std::exception& error) {
    Q_EMIT failed(QString::fromStdString(error.what()));
  }
}

/// Images are shown as they come: cameras of 30 frames per second would beat with the ticks.
void SessionLink::lookForFrames() {
  if (runner_ && runner_->takeFrames(frame_, &seen_)) Q_EMIT frames(frame_, seen_);
}

void SessionLink::emitStatus(const live::RunStatus& now) {
  reported_recording_ = now.recorder && now.recorder->state == recording::RecorderState::kRecording;
  Q_EMIT status(now);
}

void SessionLink::tick() {
  hearRetired();
  if (opening() && opening_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) finishOpening();
  if (!runner_) return;
  history_.clear();
  if (runner_->drainHistory(history_) > 0) Q_EMIT history(history_);
  if (runner_->takeSnapshot(snapshot_)) Q_EMIT snapshot(snapshot_);
  const auto now = runner_->status();
  if (now.state == live::RunState::kFailed && last_state_ != now.state) {
    Q_EMIT failed(QString::fromStdString(now.error));
    if (!now.damaged.empty()) offerRecovery(now.damaged);
  }
  last_state_ = now.state;
  if (now.command_fault_count != std::exchange(command_faults_, now.command_fault_count))
    Q_EMIT failed(QString::fromStdString(now.command_fault));
  lookForFrames();  // who compares the newest image with the status has the newest one
  emitStatus(now);
  if (++ticks_ % kReportTicks == 0) Q_EMIT report(runner_->report());
}

}  // namespace capstan::widgets
