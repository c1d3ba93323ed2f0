#pragma once

#include <array>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/base/due_times.h"
#include "core/live/occlusion.h"
#include "core/recording/occlusion_events.h"
#include "core/recording/recorder.h"

namespace capstan::live {

/// Holder of the recorder to which the pipeline's thread writes, if any. Former recorders are closed in the
/// background.
class RecordingSlot {
 public:
  /// Estimates of motor samples are reduced to `estimate_rate` [1/s of recording].
  explicit RecordingSlot(double estimate_rate) : estimates_(estimate_rate) {}
  ~RecordingSlot() {
    if (!recorder_) return;
    noteGaps();
    recorder_->close();
  }

  // The pipeline's thread.
  void begin(std::shared_ptr<recording::Recorder> recorder) {
    end();
    recorder_ = std::move(recorder);
    estimates_.restart();
    const std::lock_guard lock(mutex_);
    newest_ = recorder_;
  }
  void end() {
    if (!recorder_) return;
    noteGaps();
    closing_.push_back(
        std::async(std::launch::async, [recorder = std::move(recorder_)] { recorder->close(); }));
    recorder_ = nullptr;
  }
  void offer(const tracking::Sample& sample) {
    if (recorder_) recorder_->offer(sample);
  }
  void offer(const tracking::Snapshot& snapshot) {
    if (!recorder_) return;
    t_ = snapshot.t;
    if (snapshot.camera_updated || (snapshot.motor_updated && estimates_.due(snapshot.t)))
      recorder_->offer(snapshot);
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
  /// Whoever opens the recording later learns that it has gaps.
  void noteGaps() {
    const std::uint64_t dropped = recorder_->stats().dropped;
    if (dropped > 0) note(t_, "recorder", recording::gapsText(dropped));
  }

  base::DueTimes estimates_;
  double t_ = 0.0;  ///< of the newest snapshot [s]
  std::shared_ptr<recording::Recorder> recorder_;
  std::vector<std::future<void>> closing_;
  mutable std::mutex mutex_;
  std::shared_ptr<recording::Recorder> newest_;
};

}  // namespace capstan::live
