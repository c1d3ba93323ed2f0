#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace capstan::tracking {

/// Histogram of camera latencies in steps of 1 ms, up to 1.023 s. No allocation.
class LatencyCounts {
 public:
  static constexpr double kStep = 1e-3;  // [s]
  static constexpr std::size_t kSteps = 1024;
  static constexpr double kLongest = 1.0;  ///< what people are told of longer ones: "above 1 s" [s]

  /// Adds a latency [s]; negative ones count as 0. NaN is excluded.
  void add(double latency) {
    if (std::isnan(latency)) return;
    const double step = std::clamp(std::round(latency / kStep), 0.0, static_cast<double>(kSteps - 1));
    ++counts_[static_cast<std::size_t>(step)];
    ++count_;
  }
  std::uint64_t count() const { return count_; }
  /// Quantile (nearest rank) for `share` in 0 … 1 [s]; infinity for one of kLongest or more, which is not
  /// measured; NaN without any latency.
  double quantile(double share) const {
    const double rank = share * static_cast<double>(count_);
    double seen = 0.0;
    for (std::size_t step = 0; step < kSteps; ++step) {
      seen += static_cast<double>(counts_[step]);
      if (counts_[step] > 0 && seen >= rank)
        return kStep * static_cast<double>(step) < kLongest ? kStep * static_cast<double>(step)
                                                            : std::numeric_limits<double>::infinity();
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::array<std::uint32_t, kSteps> counts_{};
  std::uint64_t count_ = 0;
};

}  // namespace capstan::tracking
