#pragma once

namespace capstan::stats {

/// A closed interval, in the unit of what it bounds.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double x) const { return low <= x && x <= high; }
};

/// 97.5 % quantile of the standard normal distribution: half a 95 % interval, in sigmas.
inline constexpr double kNormal95 = 1.959963984540054;

}  // namespace capstan::stats
