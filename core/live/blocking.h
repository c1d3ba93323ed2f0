#pragma once

#include <array>
#include <utility>

#include "core/live/occlusion.h"
#include "core/tracking/source.h"
#include "core/vision/image_correction.h"

namespace capstan::live {

/// Blocks cameras by hand or by schedule, and corrects their images. Only changes are passed to the source.
class Blocking {
 public:
  void setByHand(bool left, bool right) { by_hand_ = {left, right}; }
  /// True if the share, the length of intervals or the cameras changed.
  bool setSchedule(const OcclusionSchedule& schedule) {
    const bool changed = scheduleWords(schedule) != scheduleWords(schedule_);
    schedule_ = schedule;
    return changed;
  }
  /// Corrects images from now on. A camera that is blocked is that of the corrected images.
  void setCorrection(const vision::ImageCorrection& correction) {
    stale_ = stale_ || correction.exchange != correction_.exchange;
    correction_ = correction;
  }
  void correct(tracking::Sample& sample) const {
    auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (!frame || correction_.none()) return;
    correction_.apply(frame->left, frame->right);
    if (!correction_.exchange) return;
    frame->skew = -frame->skew;
    std::swap(frame->blocked[0], frame->blocked[1]);
  }
  const OcclusionSchedule& schedule() const { return schedule_; }
  const std::array<bool, 2>& blocked() const { return blocked_; }
  /// True if a camera is blocked now or at some time by schedule.
  bool asked() const { return any() || schedule_.percentage > 0.0; }
  bool any() const { return blocked_[0] || blocked_[1]; }

  /// Blocks cameras for the time t [s] of the newest motor sample, before the next sample is fetched. True:
  /// the blocking changed.
  bool apply(double t, tracking::Source& source) {
    const bool scheduled = schedule_.blockedAt(t);
    const std::array<bool, 2> now = {
        by_hand_[0] || (scheduled && schedule_.cameras != BlockedCameras::kRight),
        by_hand_[1] || (scheduled && schedule_.cameras != BlockedCameras::kLeft)};
    if (now == blocked_ && !stale_) return false;
    const bool changed = now != blocked_;
    blocked_ = now;
    stale_ = false;
    source.block(now[correction_.exchange ? 1 : 0], now[correction_.exchange ? 0 : 1]);
    return changed;
  }

 private:
  OcclusionSchedule schedule_;
  std::array<bool, 2> by_hand_{}, blocked_{};
  vision::ImageCorrection correction_;
  bool stale_ = false;  ///< the source was blocked for the other order
};

}  // namespace capstan::live
