#pragma once

#include <variant>

#include "core/session/blocking.h"
#include "core/session/source.h"

namespace capstan::cli {

/// A source whose cameras are blocked on schedule, by the time of the motor sample before.
class OccludedSource {
 public:
  OccludedSource(session::Source& source, const session::OcclusionSchedule& schedule) : source_(source) {
    blocking_.setSchedule(schedule);
  }

  bool next(tracking::Sample& out) {
    blocking_.apply(t_, source_);
    if (!source_.next(out)) return false;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&out)) t_ = motor->t;
    return true;
  }

 private:
  session::Source& source_;
  session::Blocking blocking_;
  double t_ = 0.0;
};

}  // namespace capstan::cli
