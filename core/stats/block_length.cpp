#include "core/stats/block_length.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/stats/rms.h"
#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

/// Autocovariance R_k = Σ (x_t − x̄)(x_{t+k} − x̄) / n.
double autocovariance(std::span<const double> centred, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t t = 0; t + lag < centred.size(); ++t) sum += centred[t] * centred[t + lag];
  return sum / static_cast<double>(centred.size());
}

/// Autocovariances R_0 … R_M, with M by the rule in block_length.h.
std::vector<double> telling(std::span<const double> centred) {
  const auto n = static_cast<double>(centred.size());
  const auto quiet = static_cast<std::size_t>(std::max(5.0, std::ceil(std::sqrt(std::log10(n)))));
  const auto most = std::min(centred.size() - 1, static_cast<std::size_t>(std::ceil(std::sqrt(n))) + quiet);
  const double limit = 2.0 * std::sqrt(std::log10(n) / n);
  std::vector<double> covariances{autocovariance(centred, 0)};
  std::size_t last = 0;  // the largest lag with significant correlation
  while (covariances.size() <= most && covariances.size() <= last + quiet) {
    covariances.push_back(autocovariance(centred, covariances.size()));
    if (std::abs(covariances.back()) >= limit * covariances.front()) last = covariances.size() - 1;
  }
  const std::size_t width = std::min(most, 2 * std::max<std::size_t>(last, 1));
  while (covariances.size() <= width) covariances.push_back(autocovariance(centred, covariances.size()));
  covariances.resize(width + 1);
  return covariances;
}

}  // namespace

std::size_t optimalBlockLength(std::span<const double> values) {
  requireSamples(values, 1, "block length");
  if (values.size() < 10) return 1;
  std::vector<double> centred(values.begin(), values.end());
  const double centre = mean(values);
  for (double& value : centred) value -= centre;
  const std::vector<double> covariances = telling(centred);
  if (!(covariances.front() > 0.0)) return 1;
  const auto width = static_cast<double>(covariances.size() - 1);
  double g = covariances.front(), slope = 0.0;
  for (std::size_t k = 1; k < covariances.size(); ++k) {
    const double share = static_cast<double>(k) / width;
    const double weight = share <= 0.5 ? 1.0 : 2.0 * (1.0 - share);
    g += 2.0 * weight * covariances[k];
    slope += 2.0 * weight * static_cast<double>(k) * covariances[k];
  }
  const auto n = static_cast<double>(values.size());
  const double most = std::ceil(std::min(3.0 * std::sqrt(n), n / 3.0));
  const double length = std::cbrt(1.5 * (slope / g) * (slope / g) * n);
  return static_cast<std::size_t>(std::clamp(std::round(length), 1.0, most));
}

}  // namespace capstan::stats
