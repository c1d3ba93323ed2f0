#pragma once

#include <limits>

namespace capstan::base {

/// Thins a stream of times to a rate. A time before the last that was due is a clock set back: the thinning
/// restarts there, instead of pausing until that clock has caught up.
class DueTimes {
 public:
  /// `rate` [1/s]; 0: never due.
  explicit DueTimes(double rate) : period_(rate > 0.0 ? 1.0 / rate : 0.0) {}

  /// The next time is due, whatever it is.
  void restart() { next_ = last_ = -std::numeric_limits<double>::infinity(); }

  /// True when `t` [s] has reached the next due time, which then moves on by one period.
  bool due(double t) {
    if (period_ <= 0.0) return false;
    if (t < last_) restart();
    if (t < next_ - kSlack) return false;
    last_ = t;
    next_ += period_;  // a late time is caught up, a gap is not
    if (next_ + period_ < t) next_ = t + period_;
    return true;
  }

 private:
  static constexpr double kSlack = 1e-9;  // [s]

  double period_;
  double next_ = -std::numeric_limits<double>::infinity(), last_ = next_;
};

}  // namespace capstan::base
