#include "core/diagnosis/evidence/channel_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kFewestDifferences = 20;

/// Absolute changes from one finite sample to the next, without those within rounding of the last digits.
std::vector<double> changesOf(std::span<const double> values) {
  double largest = 0.0, last = std::numeric_limits<double>::quiet_NaN();
  for (const double x : values)
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  std::vector<double> changes;
  for (const double x : values) {
    if (!std::isfinite(x)) continue;
    const double change = std::abs(x - last);
    if (change > 1e-13 * largest) changes.push_back(change);  // false for the first, whose change is NaN
    last = x;
  }
  return changes;
}

/// Mean square without the values beyond 4.5 RMS of the others, found in passes.
double trimmedMeanSquare(const std::vector<double>& values) {
  double mean_square = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 6; ++pass) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const double x : values)
      if (x * x <= 4.5 * 4.5 * mean_square) sum += x * x, ++count;
    const double next = sum / static_cast<double>(count);
    if (next == mean_square) break;
    mean_square = next;
  }
  return mean_square;
}

/// Replaces the values by their first differences; NaN where one of the two values is NaN.
void difference(std::vector<double>& x) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) x[i] = x[i + 1] - x[i];
  x.pop_back();
}

/// Answers whether any of the samples from i to i + order differs from the one before.
class Motion {
 public:
  explicit Motion(std::span<const double> values) : moved_(values.size(), 0) {
    for (std::size_t i = 1; i < values.size(); ++i)
      moved_[i] = moved_[i - 1] + (values[i] != values[i - 1] ? 1U : 0U);
  }
  bool within(std::size_t i, std::size_t order) const { return moved_[i + order] != moved_[i]; }

 private:
  std::vector<std::size_t> moved_;
};

}  // namespace

double quantisationStep(std::span<const double> values) {
  const std::vector<double> changes = changesOf(values);
  if (changes.size() < kFewestDifferences) return 0.0;
  const double least = *std::min_element(changes.begin(), changes.end());
  double sum = 0.0;
  std::size_t count = 0;
  for (const double change : changes)
    if (change < 1.5 * least) sum += change, ++count;
  const double step = sum / static_cast<double>(count);
  std::size_t near = 0, whole = 0;
  for (const double change : changes) {
    const double multiple = change / step;
    if (multiple > 10.5) continue;
    ++near;
    if (std::abs(multiple - std::round(multiple)) <= 0.05) ++whole;
  }
  const bool quantised = near >= kFewestDifferences && 20 * whole >= 19 * near;
  return quantised ? step : 0.0;
}

namespace {

/// Variance of the noise by the differences of one order, and its relative standard deviation.
struct NoiseEstimate {
  double variance = 0.0, deviation = 0.0;
};

/// Estimates by differences of the orders 2 … 6, as far as there are enough of them.
std::vector<NoiseEstimate> noiseEstimates(std::span<const double> values) {
  constexpr std::size_t kMostOrder = 6;
  const Motion motion(values);
  std::vector<double> differences(values.begin(), values.end()), kept;
  std::vector<NoiseEstimate> estimates;
  double gain = 1.0, twice = 1.0;  // C(2d, d) and C(4d, 2d)
  for (std::size_t order = 1; order <= kMostOrder; ++order) {
    difference(differences);
    const auto d = static_cast<double>(order);
    gain *= 2.0 * (2.0 * d - 1.0) / d;
    twice *= 4.0 * (4.0 * d - 1.0) * (4.0 * d - 3.0) / (2.0 * d * (2.0 * d - 1.0));
    if (order == 1) continue;
    kept.clear();
    for (std::size_t i = 0; i < differences.size(); ++i)
      if (std::isfinite(differences[i]) && motion.within(i, order)) kept.push_back(differences[i]);
    if (kept.size() < kFewestDifferences) break;
    estimates.push_back({trimmedMeanSquare(kept) / gain,
                         std::sqrt(2.0 * twice / (gain * gain * static_cast<double>(kept.size())))});
  }
  return estimates;
}

}  // namespace

double whiteNoise(std::span<const double> values) {
  constexpr double kByChance = 2.0;  // standard deviations by which an estimate may exceed the least one
  if (values.size() < kFewestDifferences) return 0.0;
  const std::vector<NoiseEstimate> estimates = noiseEstimates(values);
  if (estimates.empty()) return 0.0;
  const double least = std::ranges::min(estimates, {}, &NoiseEstimate::variance).variance;
  const auto first = std::ranges::find_if(estimates, [&](const NoiseEstimate& one) {
    return one.variance <= least * (1.0 + kByChance * one.deviation);
  });
  return std::sqrt(first->variance);
}

ChannelNoise channelNoise(std::span<const double> values) {
  return {quantisationStep(values), whiteNoise(values)};
}

}  // namespace capstan::diagnosis
