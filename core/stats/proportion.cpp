#include "core/stats/proportion.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "core/base/error.h"
#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

void requireCounts(std::uint64_t hits, std::uint64_t trials, double confidence) {
  requireConfidence(confidence);
  if (trials > 0 && hits <= trials) return;
  throw base::InputError({{},
                          0,
                          "proportion",
                          fmt::format("{} of {}", hits, trials),
                          "there must be a trial, and no more hits than trials",
                          "Correct the counts"});
}

}  // namespace

Interval wilsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence) {
  requireCounts(hits, trials, confidence);
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(hits) / n;
  const double z =
      boost::math::quantile(boost::math::complement(boost::math::normal(), (1.0 - confidence) / 2.0));
  const double z2 = z * z / n;
  const double centre = (p + z2 / 2.0) / (1.0 + z2);
  const double half = std::sqrt((p * (1.0 - p) + z2 / 4.0) * z2) / (1.0 + z2);
  return {hits == 0 ? 0.0 : std::max(0.0, centre - half),
          hits == trials ? 1.0 : std::min(1.0, centre + half)};
}

Interval clopperPearsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence) {
  requireCounts(hits, trials, confidence);
  const auto k = static_cast<double>(hits);
  const auto misses = static_cast<double>(trials - hits);
  const double tail = (1.0 - confidence) / 2.0;
  using boost::math::beta_distribution;
  return {hits == 0 ? 0.0 : boost::math::quantile(beta_distribution<>(k, misses + 1.0), tail),
          hits == trials
              ? 1.0
              : boost::math::quantile(boost::math::complement(beta_distribution<>(k + 1.0, misses), tail))};
}

}  // namespace capstan::stats
