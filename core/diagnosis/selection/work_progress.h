#pragma once

#include <algorithm>
#include <limits>

namespace capstan::diagnosis {

/// Fraction of work whose end is not known: each piece of work adds its share of what may be left. It grows
/// evenly where the expectation holds, more slowly where more turns out to be necessary, and never stands
/// while work is done.
class WorkProgress {
 public:
  /// `limit`: total work after which no more is begun.
  explicit WorkProgress(double limit = std::numeric_limits<double>::infinity()) : limit_(limit) {}

  /// Sets the work that is still expected.
  void expect(double rest) {
    rest_ = std::max(rest, 0.0);
    least_ = kLeastRest * rest_;
  }
  /// Advances to the total `work` done until now. Returns the fraction, from 0 to less than 1.
  double advance(double work) {
    const double step = work - work_;
    if (!(step > 0.0)) return fraction_;
    work_ = work;
    rest_ = std::max(rest_ - step, least_);
    const double left = std::max(limit_ - work_, kLastPart * limit_);
    fraction_ += (1.0 - fraction_) * step / (step + std::min(std::max(rest_, kRestPerWork * work_), left));
    return fraction_;
  }
  double fraction() const { return fraction_; }

 private:
  /// Smallest rest, as a share of the last expectation: work that exceeds it goes on.
  static constexpr double kLeastRest = 0.2;
  /// Smallest rest per work done until now: searches of three recordings took 4, 9 and 64 times the work of
  /// their first fit, and nothing foretells it.
  static constexpr double kRestPerWork = 2.0;
  /// Rest at the limit, as a share of it: what was begun is finished.
  static constexpr double kLastPart = 0.02;

  double limit_, work_ = 0.0, rest_ = 0.0, least_ = 0.0, fraction_ = 0.0;
};

}  // namespace capstan::diagnosis
