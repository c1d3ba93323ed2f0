#pragma once

namespace capstan::stats {

/// Closed interval, in the unit of the quantity that it bounds.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double x) const { return low <= x && x <= high; }
};

/// 97.5 % quantile of the standard normal distribution: half-width of a 95 % interval in standard deviations.
inline constexpr double kNormal95 = 1.959963984540054;

}  // namespace capstan::stats
