#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "core/live/blocking.h"
#include "core/live/in_use.h"
#include "core/live/playback_clock.h"
#include "core/live/plotted_steps.h"
#include "core/live/publisher.h"
#include "core/live/rate_meter.h"
#include "core/live/recording_slot.h"
#include "core/live/run_fault.h"
#include "core/live/runner.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/option_changes.h"
#include "core/tracking/take_over.h"

namespace capstan::live {

/// The pipeline's thread, and what it shares with others.
class Runner::Impl {
 public:
  Impl(std::unique_ptr<tracking::Source> source, tracking::TrackingPipeline pipeline,
       const RunnerOptions& options)
      : options_(options),
        source_(std::move(source)),
        info_(source_->info()),
        pipeline_(std::move(pipeline)),
        publisher_(RunnerOptions::kHistoryCapacity),
        in_use_(info_, pipeline_) {
    status_.speed = speed_ = options.speed;
    thread_ = std::thread([this] { work(); });
  }

  ~Impl() {
    post([this] { quit_ = true; });
    thread_.join();
  }

  const tracking::SourceInfo& info() const { return info_; }
  Publisher& publisher() { return publisher_; }

  void post(std::function<void()> command) {
    {
      const std::lock_guard lock(mutex_);
      commands_.push_back(std::move(command));
      pending_.store(true, std::memory_order_release);
    }
    wake_.notify_all();
  }

  void setMode(RunState mode) {
    post([this, mode] {
      if (mode_ == Mode::kDone) return;
      mode_ = mode == RunState::kRunning ? Mode::kRun : Mode::kPause;
      pacer_.restart();
      meter_.restart();
    });
  }

  void stepFrame() {
    post([this] {
      if (mode_ == Mode::kDone) return;
      mode_ = Mode::kStep;
      step_end_ = t_ + kStepWithoutCameras;
    });
  }

  void setSpeed(double speed) {
    post([this, speed] {
      speed_ = speed <= 0.0 ? 0.0 : std::clamp(speed, 0.1, 50.0);
      pacer_.restart();
    });
  }

  void block(bool left, bool right) {
    post([this, left, right] { blocking_.setByHand(left, right); });
  }
  void setOcclusion(const OcclusionSchedule& schedule) {
    post([this, schedule] {
      if (blocking_.setSchedule(schedule)) recording_.noteOcclusion(t_, schedule, !info_.live);
    });
  }

  void setRegistration(const Eigen::Isometry3d& pose) {
    in_use_.setRegistration(pose);
    post([this, pose] {
      const auto& former = pipeline_.registration();
      if (!former || !former->isApprox(pose)) report_.restart(tracking::ReportStart::kRegistration);
      pipeline_.setRegistration(pose);
      if (listener_) listener_.begin(pipeline_);
      recording_.setRegistration(t_, pose);
    });
  }

  void setMarker(const vision::MarkerOptions& marker) {
    const std::string text = base::writeYaml(marker);
    in_use_.setMarker(text);
    post([this, marker, text] {
      pipeline_.setMarker(marker);
      recording_.setMarker(t_, text);
    });
  }

  void setRobot(const robot::Description& robot, const std::string& note) {
    tracking::SourceInfo info = in_use_.info();
    info.robot = robot;
    rebuild(info, in_use_.tracking(), tracking::ReportStart::kRobot, "robot", note);
    in_use_.setRobot(robot);
  }

  void setTracking(const tracking::TrackingOptions& options) {
    const std::string changes = tracking::optionChanges(in_use_.tracking(), options);
    if (changes.empty()) return;
    rebuild(in_use_.info(), options, tracking::ReportStart::kFilterOptions, "filter options", changes);
    in_use_.setTracking(options);
  }

  void setRig(const vision::StereoRig& rig, const std::string& note) {
    tracking::SourceInfo info = in_use_.info();
    info.rig = rig;
    rebuild(info, in_use_.tracking(), tracking::ReportStart::kCameras, "cameras", note);
    in_use_.setRig(rig);
  }
  void setImages(const vision::ImageCorrection& images) {
    in_use_.setImages(images);
    post([this, images] {
      blocking_.setCorrection(images);
      recording_.note(t_, "cameras", images.none() ? "images as they come" : images.words());
    });
  }

  void listen(Listener listener) {
    post([this, listener = std::move(listener)] {
      if (listener) listener.begin(pipeline_);
      listener_ = listener;
    });
  }

  void resetErrors() {
    post([this] { report_.restart(tracking::ReportStart::kReset); });
  }
  void note(std::string text) {
    post([this, text = std::move(text)] { recording_.note(t_, "note", text); });
  }
  void command(Command given) {
    post([this, given = std::move(given)] { given(*source_, pipeline_); });
  }
  const InUse& inUse() const { return in_use_; }
  void startRecording(const std::filesystem::path& path, const recording::SessionHeader& header,
                      const recording::RecorderOptions& options) {
    auto recorder = std::make_shared<recording::Recorder>(path, in_use_.of(header), options);
    recording_.announce(recorder);
    post([this, recorder] {
      recording_.begin(recorder);
      recording_.noteOcclusion(t_, blocking_, !info_.live);
    });
  }
  void stopRecording() {
    post([this] { recording_.end(); });
  }

  std::shared_ptr<const recording::Recorder> recorder() const { return recording_.newest(); }

  RunStatus status() const {
    RunStatus status = kept(status_);
    if (const auto recorder = recording_.newest()) {
      status.recorder = recorder->stats();
      status.recording = recorder->path().string();
    }
    return status;
  }

  tracking::TrackReport report() const { return kept(published_report_); }
  std::vector<tracking::HealthCheck> health() const {
    return tracking::healthOf(report(), in_use_.robot(), in_use_.tracking().memory);
  }

  bool waitUntilIdle(double seconds) {
    std::unique_lock lock(mutex_);
    return idle_.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
      return commands_.empty() && !executing_ && status_.state != RunState::kRunning;
    });
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kStepWithoutCameras = 1.0 / 15.0;  // [s]
  static constexpr auto kReportPeriod = std::chrono::milliseconds(100);
  static constexpr auto kPatience = std::chrono::milliseconds(20);  // of commands while a source is silent

  enum class Mode { kPause, kRun, kStep, kDone };

  template <class T>
  T kept(const T& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  /// Replaces the pipeline before the next sample, which a recording under way notes.
  void rebuild(const tracking::SourceInfo& info, const tracking::TrackingOptions& options,
               tracking::ReportStart start, const std::string& kind, const std::string& note) {
    auto next = std::make_shared<tracking::TrackingPipeline>(tracking::makePipeline(info, options));
    post([this, next, start, kind, note] {
      tracking::takeOver(pipeline_, *next);
      pipeline_ = std::move(*next);
      report_.restart(start);
      if (listener_) listener_.begin(pipeline_);
      recording_.note(t_, kind, note);
    });
  }

  void work() {
    while (!quit_) {
      execute();
      if (quit_) break;
      if (mode_ == Mode::kPause || mode_ == Mode::kDone) {
        rest();
        continue;
      }
      try {
        advance();
      } catch (const std::exception& error) {
        finish(RunState::kFailed, &error);
      }
    }
  }

  /// Executes all posted commands in order.
  void execute() {
    if (!pending_.load(std::memory_order_acquire)) return;
    std::deque<std::function<void()>> commands;
    {
      const std::lock_guard lock(mutex_);
      commands.swap(commands_);
      pending_.store(false, std::memory_order_relaxed);
      executing_ = true;
    }
    for (auto& command : commands) {
      try {
        command();
      } catch (const std::exception& error) {
        const std::lock_guard lock(mutex_);
        status_.command_fault = error.what();
        ++status_.command_fault_count;
      }
    }
    applyBlocking();
    publishStatus(true);
    {
      const std::lock_guard lock(mutex_);
      executing_ = false;
    }
    idle_.notify_all();
  }

  void rest() {
    if (info_.real_time) {
      if (mode_ == Mode::kPause) recording_.observePause();
      if (begun_) source_->discard();  // it is not tracked after the pause
      publishStatus(false);
    }
    std::unique_lock lock(mutex_);
    const auto commanded = [&] { return !commands_.empty(); };
    info_.real_time ? void(wake_.wait_for(lock, kPatience, commanded)) : wake_.wait(lock, commanded);
  }

  /// Processes one sample when it is due; otherwise waits until it is due or a command arrives.
  void advance() {
    begun_ = true;
    applyBlocking();
    if (!fetched_ && !source_->ready(kPatience)) return publishStatus(false);
    if (!fetched_ && !source_->next(sample_)) return finish(RunState::kEnded);
    if (!fetched_) blocking_.correct(sample_);
    fetched_ = true;
    if (mode_ == Mode::kRun && speed_ > 0.0 && !info_.real_time) {
      const auto due = pacer_.due(tracking::arrivalOf(sample_), speed_, Clock::now());
      if (due > Clock::now()) {
        publishStatus(false);
        std::unique_lock lock(mutex_);
        if (wake_.wait_until(lock, due, [&] { return !commands_.empty(); })) return;
      }
    }
    fetched_ = false;
    take();
  }

  void take() {
    t_ = tracking::arrivalOf(sample_);
    const bool motor = std::holds_alternative<tracking::MotorSample>(sample_);
    const bool camera = tracking::fromCamera(sample_);
    if (motor) motor_t_ = t_;
    recording_.offer(sample_);
    const tracking::Snapshot& snapshot = pipeline_.step(sample_);
    report_.add(snapshot);
    if (listener_) listener_.take(sample_, snapshot);
    recording_.offer(snapshot);
    publisher_.publish(snapshot, plotted_.take(snapshot));
    publishFrames(snapshot);
    meter_.count(motor, camera);
    if (mode_ == Mode::kStep && (camera || (motor && !info_.rig && !camera_seen_ && t_ >= step_end_)))
      mode_ = Mode::kPause;
    camera_seen_ = camera_seen_ || camera;
    publishStatus(mode_ == Mode::kPause);
  }

  void publishFrames(const tracking::Snapshot& snapshot) {
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample_);
    if (!frame) return;
    if (mode_ == Mode::kStep || speed_ > 0.0)
      publisher_.publish(*frame, snapshot);
    else
      publisher_.publishSometimes(*frame, snapshot);
  }

  void applyBlocking() {
    if (blocking_.apply(motor_t_, *source_)) recording_.noteOcclusion(t_, blocking_.blocked(), !info_.live);
  }

  void finish(RunState state, const std::exception* error = nullptr) {
    mode_ = Mode::kDone;
    {
      const std::lock_guard lock(mutex_);
      done_ = state;
      if (error) noteFault(*error, status_);
    }
    publishStatus(true);
  }

  void publishStatus(bool now) {
    const auto wall = Clock::now();
    if (!now && wall - reported_ < kReportPeriod) return;
    reported_ = wall;
    meter_.look(t_, wall);
    std::vector<tracking::SideStatus> sides = source_->sides();
    if (begun_) recording_.observe(sides);
    {
      const std::lock_guard lock(mutex_);
      published_report_ = report_;
      tracking::noteSource(info_, sides, published_report_);
      status_.state = mode_ == Mode::kDone    ? done_
                      : mode_ == Mode::kPause ? RunState::kPaused
                                              : RunState::kRunning;
      status_.t = t_;
      status_.speed = speed_;
      status_.real_time_factor = meter_.realTimeFactor();
      status_.motor_rate = meter_.motorRate();
      status_.frame_rate = meter_.cameraRate();
      status_.blocked = blocking_.blocked();
      status_.occlusion = blocking_.schedule();
      status_.occlusion_added = !info_.live && blocking_.asked();
      status_.sides = std::move(sides);
    }
    if (mode_ == Mode::kPause || mode_ == Mode::kDone) idle_.notify_all();
  }

  const RunnerOptions options_;
  const std::unique_ptr<tracking::Source> source_;
  const tracking::SourceInfo info_;
  tracking::TrackingPipeline pipeline_;
  Publisher publisher_;
  InUse in_use_;

  // The pipeline's thread.
  Mode mode_ = Mode::kPause;
  double speed_ = 1.0, step_end_ = 0.0, t_ = 0.0, motor_t_ = 0.0;
  PlottedSteps plotted_{RunnerOptions::kHistoryRate};
  bool quit_ = false, begun_ = false, fetched_ = false, camera_seen_ = false;
  tracking::Sample sample_;
  Blocking blocking_;
  RecordingSlot recording_{RunnerOptions::kEstimateRate, info_.sender_waits};
  Listener listener_;
  tracking::TrackReport report_;
  PlaybackClock pacer_;
  RateMeter meter_;
  Clock::time_point reported_{};

  mutable std::mutex mutex_;  ///< protects all members below
  std::condition_variable wake_, idle_;
  std::deque<std::function<void()>> commands_;
  std::atomic<bool> pending_{false};
  bool executing_ = false;
  RunStatus status_;
  RunState done_ = RunState::kEnded;
  tracking::TrackReport published_report_;

  std::thread thread_;
};

}  // namespace capstan::live
