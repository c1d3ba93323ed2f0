#include "core/stats/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace capstan::stats {

std::vector<double> quantiles(std::span<const double> values, std::span<const double> shares) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double x) { return !std::isnan(x); });
  std::sort(sorted.begin(), sorted.end());

  std::vector<double> result;
  result.reserve(shares.size());
  for (const double share : shares) {
    CAPSTAN_ASSERT(share >= 0.0 && share <= 1.0);
    if (sorted.empty()) {
      result.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const double h = static_cast<double>(sorted.size() - 1) * share;
    const auto below = static_cast<std::size_t>(std::floor(h));
    const double part = h - std::floor(h);
    const double low = sorted[below];
    result.push_back(part == 0.0 ? low : low + part * (sorted[below + 1] - low));
  }
  return result;
}

double quantile(std::span<const double> values, double share) {
  const double shares[] = {share};
  return quantiles(values, shares).front();
}

double median(std::span<const double> values) { return quantile(values, 0.5); }

}  // namespace capstan::stats
