#pragma once

#include <array>
#include <string>

#include "core/session/occlusion.h"
#include "core/session/source.h"

namespace capstan::session {

/// Which cameras are blocked: by hand or by schedule. The source hears of changes only.
class Blocking {
 public:
  void setByHand(bool left, bool right) { by_hand_ = {left, right}; }
  void setSchedule(const OcclusionSchedule& schedule) { schedule_ = schedule; }
  const OcclusionSchedule& schedule() const { return schedule_; }
  const std::array<bool, 2>& blocked() const { return blocked_; }
  bool any() const { return blocked_[0] || blocked_[1]; }

  /// At time t of the newest motor sample, before the next sample is fetched. True: something changed.
  bool apply(double t, Source& source) {
    const bool scheduled = schedule_.blockedAt(t);
    const std::array<bool, 2> now = {by_hand_[0] || scheduled, by_hand_[1] || scheduled};
    if (now == blocked_) return false;
    blocked_ = now;
    source.block(now[0], now[1]);
    return true;
  }

  std::string text() const {
    if (!any()) return "free";
    return blocked_[0] && blocked_[1] ? "both blocked" : blocked_[0] ? "left blocked" : "right blocked";
  }

 private:
  OcclusionSchedule schedule_;
  std::array<bool, 2> by_hand_{}, blocked_{};
};

}  // namespace capstan::session
