#pragma once

#include <variant>

#include "core/session/occlusion.h"
#include "core/session/source.h"

namespace capstan::cli {

/// A source whose cameras are blocked on schedule, by the arrival time of the sample before.
class OccludedSource {
 public:
  OccludedSource(session::Source& source, const session::OcclusionSchedule& schedule)
      : source_(source), schedule_(schedule) {}

  bool next(tracking::Sample& out) {
    if (schedule_.percentage > 0.0 && schedule_.blockedAt(t_) != blocked_) {
      blocked_ = !blocked_;
      source_.block(blocked_, blocked_);
    }
    if (!source_.next(out)) return false;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&out)) t_ = motor->t;
    return true;
  }

 private:
  session::Source& source_;
  session::OcclusionSchedule schedule_;
  double t_ = 0.0;
  bool blocked_ = false;
};

}  // namespace capstan::cli
