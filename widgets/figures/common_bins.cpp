#include "widgets/figures/common_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/stats/quantile.h"

namespace capstan::widgets {

namespace {

struct Spread {
  double low = std::numeric_limits<double>::infinity(), high = -low;                 ///< range of all samples
  double near_low = std::numeric_limits<double>::infinity(), near_high = -near_low;  ///< without far samples
  double width = std::numeric_limits<double>::infinity();                            ///< width of a bin
};

void include(Spread& spread, std::span<const double> values) {
  const double shares[] = {0.25, 0.75};
  const std::vector<double> quartiles = stats::quantiles(values, shares);
  const double iqr = quartiles[1] - quartiles[0];
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  spread.low = std::min(spread.low, *low);
  spread.high = std::max(spread.high, *high);
  spread.near_low = std::min(spread.near_low, std::max(*low, quartiles[0] - kReach * iqr));
  spread.near_high = std::max(spread.near_high, std::min(*high, quartiles[1] + kReach * iqr));
  if (iqr > 0.0)
    spread.width = std::min(spread.width, 2.0 * iqr / std::cbrt(static_cast<double>(values.size())));
}

}  // namespace

std::optional<CommonBins> commonBins(const std::vector<std::span<const double>>& samples) {
  Spread spread;
  for (const auto& values : samples)
    if (!values.empty()) include(spread, values);
  if (!(spread.low <= spread.high)) return std::nullopt;
  constexpr double kLimit = static_cast<double>(kMostBins);
  double low = spread.low, high = spread.high;
  if (std::isfinite(spread.width) && !((high - low) / spread.width <= kLimit)) {
    low = spread.near_low;
    high = spread.near_high;
  }
  // If all samples are equal, or too close for doubles to represent the bins' edges: one bin around them.
  const double size = std::max(std::abs(low), std::abs(high));
  if (!(high - low > 1e-9 * size)) {
    const double half = size > 0.0 ? 0.05 * size : 0.5;
    return CommonBins{0.5 * (low + high) - half, 0.5 * (low + high) + half, 1};
  }
  const double bins = std::isfinite(spread.width) ? std::ceil((high - low) / spread.width) : 1.0;
  return CommonBins{low, high, static_cast<std::size_t>(std::clamp(bins, 1.0, kLimit))};
}

}  // namespace capstan::widgets
