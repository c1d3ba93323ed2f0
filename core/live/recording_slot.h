#pragma once

#include <array>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/base/due_times.h"
#include "core/live/blocking.h"
#include "core/live/pause_watch.h"
#include "core/recording/occlusion_events.h"
#include "core/recording/recorder.h"
#include "core/tracking/arrival.h"
#include "core/tracking/gate_watch.h"
#include "core/tracking/side_watch.h"

namespace capstan::live {

/// Holder of the recorder to which the pipeline's thread writes, if any. Notes as events what changes at the
/// sides of a live source, whether its cameras are used, and its pauses; also how these are when a recording
/// begins. Former recorders are closed in the background.
class RecordingSlot {
 public:
  /// Estimates of motor samples are reduced to `estimate_rate` [1/s of recording]. `sender_waits`: of the
  /// source.
  explicit RecordingSlot(double estimate_rate, bool sender_waits = false)
      : estimates_(estimate_rate), pauses_(sender_waits) {}
  ~RecordingSlot() {
    if (!recorder_) return;
    noteGaps();
    recorder_->close();
  }

  /// newest() is this recorder from now on, which begin() will get. Any thread may call it.
  void announce(std::shared_ptr<recording::Recorder> recorder) {
    const std::lock_guard lock(mutex_);
    newest_ = std::move(recorder);
  }

  // The pipeline's thread.
  void begin(std::shared_ptr<recording::Recorder> recorder) {
    end();
    recorder_ = std::move(recorder);
    estimates_.restart();
    sides_.restate(), gate_.restate(), pauses_.restate();
  }
  void end() {
    if (!recorder_) return;
    noteGaps();
    std::erase_if(closing_, [](const std::future<void>& one) {
      return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    closing_.push_back(
        std::async(std::launch::async, [recorder = std::move(recorder_)] { recorder->close(); }));
    recorder_ = nullptr;
  }
  void offer(const tracking::Sample& sample) {
    t_ = tracking::arrivalOf(sample);
    observePause(false);
    if (recorder_ && !recorder_->offer(sample)) endIfFailed();
  }
  void offer(const tracking::Snapshot& snapshot) {
    if (auto sentence = gate_.observe(snapshot)) note(t_, "camera", std::move(*sentence));
    if (!recorder_) return;
    if (snapshot.camera_updated || (snapshot.motor_updated && estimates_.due(snapshot.t)))
      recorder_->offer(snapshot);
  }
  /// Notes what has changed at the sides of the source.
  void observe(const std::vector<tracking::SideStatus>& sides) {
    for (std::string& sentence : sides_.observe(sides)) note(t_, "source", std::move(sentence));
  }
  /// Notes that a live source is paused. The next sample ends the pause.
  void observePause(bool paused = true) {
    if (auto sentence = pauses_.observe(paused, t_, PauseWatch::Clock::now()))
      note(t_, "session", std::move(*sentence));
  }
  void note(double t, std::string kind, std::string text) {
    if (recorder_) recorder_->note(t, std::move(kind), std::move(text));
  }
  /// Notes a schedule, or the cameras that are blocked from now on; `added`: the occlusion was added to a
  /// source that is itself a recording.
  void noteOcclusion(double t, const OcclusionSchedule& schedule, bool added) {
    note(t, recording::kOcclusionKind, scheduleWords(schedule) + (added ? recording::kAddedOcclusion : ""));
  }
  void noteOcclusion(double t, const std::array<bool, 2>& blocked, bool added) {
    note(t, recording::kOcclusionKind, recording::occlusionText(blocked, added));
  }
  /// Notes the schedule and the cameras that are blocked, if any.
  void noteOcclusion(double t, const Blocking& blocking, bool added) {
    if (blocking.schedule().percentage > 0.0) noteOcclusion(t, blocking.schedule(), added);
    if (blocking.any()) noteOcclusion(t, blocking.blocked(), added);
  }
  void setRegistration(double t, const Eigen::Isometry3d& base_from_camera) {
    if (recorder_) recorder_->setRegistration(t, base_from_camera);
  }
  void setMarker(double t, const std::string& marker) {
    if (recorder_) recorder_->setMarker(t, marker);
  }

  /// Current recorder, or the last one; null: none yet. Any thread may call it.
  std::shared_ptr<recording::Recorder> newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
  }

 private:
  /// Its memory is given back; newest() keeps its state.
  void endIfFailed() {
    if (recorder_->stats().state == recording::RecorderState::kFailed) end();
  }
  /// Whoever opens the recording later learns that it has gaps.
  void noteGaps() {
    const std::uint64_t dropped = recorder_->stats().dropped;
    if (dropped > 0) note(t_, "recorder", recording::gapsText(dropped));
  }

  base::DueTimes estimates_;
  PauseWatch pauses_;
  tracking::SideWatch sides_;
  tracking::GateWatch gate_;
  double t_ = 0.0;  ///< arrival of the newest sample [s]
  std::shared_ptr<recording::Recorder> recorder_;
  std::vector<std::future<void>> closing_;
  mutable std::mutex mutex_;
  std::shared_ptr<recording::Recorder> newest_;
};

}  // namespace capstan::live
