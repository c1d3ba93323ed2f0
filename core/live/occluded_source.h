#pragma once

#include "core/live/blocking.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// A source whose cameras are blocked by schedule, at the time of the previous motor sample.
class OccludedSource final : public tracking::Source {
 public:
  /// `source` must outlive this object.
  OccludedSource(tracking::Source& source, const OcclusionSchedule& schedule)
      : source_(source), t_(source.info().begin) {
    blocking_.setSchedule(schedule);
  }

  const tracking::SourceInfo& info() const override { return source_.info(); }
  bool next(tracking::Sample& out) override {
    blocking_.apply(t_, source_);
    if (!source_.next(out)) return false;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&out)) t_ = motor->t;
    return true;
  }
  bool ready(std::chrono::milliseconds wait) override { return source_.ready(wait); }
  void discard() override { source_.discard(); }
  std::vector<tracking::SideStatus> sides() const override { return source_.sides(); }
  /// Blocks cameras by hand, in addition to the schedule.
  void block(bool left, bool right) override { blocking_.setByHand(left, right); }
  /// True if a camera is blocked now.
  bool blocked() const { return blocking_.any(); }

 private:
  tracking::Source& source_;
  Blocking blocking_;
  double t_;
};

}  // namespace capstan::live
