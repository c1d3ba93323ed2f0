#include <algorithm>
#include <cmath>

#include "core/diagnosis/evidence/channel_noise.h"
#include "core/diagnosis/fit/chain_simulation.h"

namespace capstan::diagnosis {
namespace {

constexpr double kAway = 2.0;     // level at which an approach to zero ends, over the level where it begins
constexpr double kLingers = 1.5;  // lowest such beginning, over the noise: about zero, |noise| averages 0.8 σ

/// Centred moving average over ± half rows.
std::vector<double> smoothed(std::span<const double> x, std::size_t half) {
  std::vector<double> sums(x.size() + 1, 0.0), mean(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) sums[k + 1] = sums[k] + x[k];
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t reach = std::min({half, k, x.size() - 1 - k});
    mean[k] = (sums[k + reach + 1] - sums[k - reach]) / static_cast<double>(2 * reach + 1);
  }
  return mean;
}

}  // namespace

std::vector<double> withSigns(std::span<const double> magnitude) {
  std::vector<double> load(magnitude.begin(), magnitude.end());
  if (load.size() < 20) return load;
  const std::vector<double> level = smoothed(magnitude, load.size() / 2000 + 2);
  std::vector<double> sorted = level;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10),
                   sorted.end());
  const double large = sorted[sorted.size() * 9 / 10];
  const double reach = std::max(0.06 * large, kLingers * whiteNoise(magnitude));
  double sign = 1.0;
  std::size_t k = 0;
  while (k < level.size()) {
    if (!(level[k] < reach)) {
      load[k] *= sign, ++k;
      continue;
    }
    // An approach to zero ends when the level has risen well above it; the sign changes at the minimum.
    std::size_t end = k;
    while (end < level.size() && level[end] < kAway * reach) ++end;
    const auto lowest = std::min_element(level.begin() + static_cast<std::ptrdiff_t>(k),
                                         level.begin() + static_cast<std::ptrdiff_t>(end));
    const auto turn = static_cast<std::size_t>(lowest - level.begin());
    const bool passes = k > 0 && end < level.size();
    for (std::size_t i = k; i < end; ++i) load[i] *= passes && i >= turn ? -sign : sign;
    if (passes) sign = -sign;
    k = end;
  }
  return load;
}

}  // namespace capstan::diagnosis
