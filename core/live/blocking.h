#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/live/occlusion.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// Blocks cameras by hand or by schedule. Only changes are passed to the source.
class Blocking {
 public:
  void setByHand(bool left, bool right) { by_hand_ = {left, right}; }
  /// True if the share or the length of intervals changed.
  bool setSchedule(const OcclusionSchedule& schedule) {
    const bool changed = scheduleWords(schedule) != scheduleWords(schedule_);
    schedule_ = schedule;
    return changed;
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
    if (now == blocked_) return false;
    blocked_ = now;
    source.block(now[0], now[1]);
    return true;
  }

  /// Descriptions of the schedule and of the cameras that are blocked now.
  std::vector<std::string> words() const {
    std::vector<std::string> all;
    if (schedule_.percentage > 0.0) all.push_back(scheduleWords(schedule_));
    if (any()) all.push_back(text());
    return all;
  }
  std::string text() const {
    if (!any()) return "free";
    return blocked_[0] && blocked_[1] ? "both blocked" : blocked_[0] ? "left blocked" : "right blocked";
  }

 private:
  OcclusionSchedule schedule_;
  std::array<bool, 2> by_hand_{}, blocked_{};
};

}  // namespace capstan::live
