#pragma once

namespace capstan::stats {

/// A closed interval, in the unit of what it bounds.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  bool contains(double x) const { return low <= x && x <= high; }
};

}  // namespace capstan::stats
