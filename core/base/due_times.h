#pragma once

#include <limits>

namespace capstan::base {

/// Thins a stream of times to a given rate. When a time is earlier than the last due time, the clock was set
/// back: the thinning restarts at that time instead of waiting until the clock has caught up.
class DueTimes {
 public:
  /// `rate` [1/s] of the due times; at 0 no time is ever due.
  explicit DueTimes(double rate) : period_(rate > 0.0 ? 1.0 / rate : 0.0) {}

  /// Makes the next time due, whatever its value.
  void restart() { next_ = last_ = -std::numeric_limits<double>::infinity(); }

  /// Returns true when `t` [s] has reached the next due time, and then moves the due time on by one period.
  bool due(double t) {
    if (period_ <= 0.0) return false;
    if (t < last_) restart();
    if (t < next_ - kSlack) return false;
    last_ = t;
    next_ += period_;  // catches up after one late time, but not after a gap
    if (next_ + period_ < t) next_ = t + period_;
    return true;
  }

 private:
  static constexpr double kSlack = 1e-9;  // [s]

  double period_;
  double next_ = -std::numeric_limits<double>::infinity(), last_ = next_;
};

}  // namespace capstan::base
