#include "core/stats/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/error.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"
#include "tests/core/stats/michelson.h"

namespace capstan::stats {
namespace {

/// Mean and standard deviation over resamples of the mean of ⌈n/l⌉ = n/l whole blocks, in closed form: blocks
/// are drawn independently, so the mean is that of all blocks' means and the variance theirs · l/n.
Interval meanAndErrorOfBlocks(std::span<const double> values, std::size_t length) {
  const std::size_t n = values.size();
  std::vector<double> means(n);
  for (std::size_t start = 0; start < n; ++start)
    for (std::size_t k = 0; k < length; ++k)
      means[start] += values[(start + k) % n] / static_cast<double>(length);
  const auto count = static_cast<double>(means.size());
  const double centre = std::accumulate(means.begin(), means.end(), 0.0) / count;
  double squares = 0.0;
  for (const double m : means) squares += (m - centre) * (m - centre);
  return {centre, std::sqrt(squares / count * static_cast<double>(length) / static_cast<double>(n))};
}

/// x_t = φ x_{t−1} + normal noise, from its stationary distribution.
std::vector<double> autoregression(double phi, std::size_t n, base::Random& random) {
  std::vector<double> values(n);
  double x = random.normal() / std::sqrt(1.0 - phi * phi);
  for (double& value : values) value = x = phi * x + random.normal();
  return values;
}

// A deviation estimated from m values is off by a share of about 1/√(2m): 0.5 % for 20,000; the mean by σ/√m.
TEST(Bootstrap, AgreesWithTheClosedFormOfTheMean) {
  for (const std::size_t length : {1U, 5U, 20U}) {
    base::Random random(11, "bootstrap");
    const BootstrapReport report =
        bootstrap(kMichelson, mean, {.block_length = length, .resamples = 20000}, random);
    const auto [centre, error] = meanAndErrorOfBlocks(kMichelson, length);
    EXPECT_EQ(report.estimate, mean(kMichelson));
    EXPECT_NEAR(report.standard_error / error, 1.0, 0.02) << length;
    EXPECT_NEAR(mean(report.replicates), centre, 4.0 * error / std::sqrt(20000.0)) << length;
  }
}

// Of an AR(1) process the mean's variance tends to σ²/((1 − φ)² n); independent samples make it too small by
// (1 − φ)/(1 + φ).
TEST(Bootstrap, BlocksKnowOfCorrelationWhereSingleSamplesDoNot) {
  const double phi = 0.6;
  const std::size_t n = 40000;
  base::Random random(3, "bootstrap");
  const std::vector<double> values = autoregression(phi, n, random);
  const double expected = 1.0 / (1.0 - phi) / std::sqrt(static_cast<double>(n));
  const BootstrapReport blocks = bootstrap(values, mean, {.block_length = 80, .resamples = 1000}, random);
  EXPECT_NEAR(blocks.standard_error / expected, 1.0, 0.12);
  const BootstrapReport single = bootstrap(values, mean, {.block_length = 1, .resamples = 1000}, random);
  EXPECT_NEAR(single.standard_error / expected, std::sqrt((1.0 - phi) / (1.0 + phi)), 0.05);
}

// For many independent samples the percentile interval of the mean is the normal one.
TEST(Bootstrap, PercentileIntervalOfManySamplesIsTheNormalOne) {
  base::Random random(5, "bootstrap");
  std::vector<double> values(2000);
  for (double& x : values) x = random.normal(3.0, 2.0);
  const BootstrapReport report =
      bootstrap(values, mean, {.block_length = 1, .resamples = 10000, .confidence = 0.9}, random);
  const double half = 1.6448536269514722 * standardDeviation(values) / std::sqrt(2000.0);
  EXPECT_NEAR(report.interval.low, mean(values) - half, 0.04 * half);
  EXPECT_NEAR(report.interval.high, mean(values) + half, 0.04 * half);
  EXPECT_EQ(report.interval.low, quantile(report.replicates, (1.0 - 0.9) / 2.0));
}

TEST(Bootstrap, OneBlockOfTheWholeRecordingHasAllItsSamples) {
  base::Random random(1);
  const auto sorted = [](std::span<const double> values) {
    std::vector<double> all(values.begin(), values.end());
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto hasAll = [&](std::span<const double> values) { return sorted(values) == sorted(kMichelson); };
  const BootstrapReport report =
      bootstrap(kMichelson, hasAll, {.block_length = 100, .resamples = 50}, random);
  for (const double value : report.replicates) EXPECT_EQ(value, 1.0);
}

TEST(Bootstrap, BlocksKeepNeighboursTogetherAndTheLastIsCut) {
  std::vector<double> values(10);
  std::iota(values.begin(), values.end(), 0.0);
  const auto neighbours = [](std::span<const double> chosen) {
    EXPECT_EQ(chosen.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i)
      if (i % 4 != 0) {
        EXPECT_EQ(chosen[i], std::fmod(chosen[i - 1] + 1.0, 10.0));
      }
    return chosen[0];
  };
  base::Random random(1);
  bootstrap(values, neighbours, {.block_length = 4, .resamples = 100}, random);
}

// Of 7 + 3 + 10 samples and blocks of 4 there are 29 starts, 4 of which begin at a piece's first sample: the
// pair of samples about a gap comes by chance, 4/29 of the time, and never in a block.
TEST(Bootstrap, NoBlockReachesAcrossAGap) {
  std::vector<double> values(20);
  std::iota(values.begin(), values.end(), 0.0);
  double before = 0.0, across = 0.0, inside = 0.0, together = 0.0;
  const auto count = [&](std::span<const double> chosen) {
    for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
      before += chosen[i] == 6.0 ? 1.0 : 0.0;
      across += chosen[i] == 6.0 && chosen[i + 1] == 7.0 ? 1.0 : 0.0;
      inside += chosen[i] == 14.0 ? 1.0 : 0.0;
      together += chosen[i] == 14.0 && chosen[i + 1] == 15.0 ? 1.0 : 0.0;
    }
    return chosen[0];
  };
  base::Random random(3);
  bootstrap(values, count, {.block_length = 4, .resamples = 20000, .pieces = {7, 3, 10}}, random);
  EXPECT_NEAR(across / before, 4.0 / 29.0, 0.01);
  EXPECT_GT(together / inside, 0.7);
}

// The end of a resample cuts its last block, one of about 22: so much, and no more, may be missing.
TEST(Bootstrap, SamplesBesideAGapAreDrawnAsOftenAsOthers) {
  std::vector<double> values(200), times(200);
  std::iota(values.begin(), values.end(), 0.0);
  const auto count = [&](std::span<const double> chosen) {
    for (const double x : chosen) times[static_cast<std::size_t>(x)] += 1.0;
    return chosen[0];
  };
  base::Random random(4);
  constexpr std::size_t kResamples = 20000;
  bootstrap(values, count, {.block_length = 10, .resamples = kResamples, .pieces = {70, 30, 100}}, random);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i] / (kResamples + 1.0), 1.0, 0.06) << i;
}

TEST(Bootstrap, DifferenceOfIndependentRecordingsAddsTheirVariances) {
  base::Random random(9, "bootstrap");
  const std::vector<double> one = autoregression(0.3, 600, random);
  const std::vector<double> other = autoregression(-0.2, 400, random);
  const BootstrapOptions options = {.block_length = 10, .resamples = 20000};
  const BootstrapReport report = bootstrapDifference(one, other, mean, options, random);
  EXPECT_EQ(report.estimate, mean(one) - mean(other));
  const double expected =
      std::hypot(meanAndErrorOfBlocks(one, 10).high, meanAndErrorOfBlocks(other, 10).high);
  EXPECT_NEAR(report.standard_error / expected, 1.0, 0.02);
}

TEST(Bootstrap, WhatPairedSignalsShareCancels) {
  base::Random random(9, "bootstrap");
  const std::vector<double> one = autoregression(0.5, 300, random);
  std::vector<double> other;
  for (const double x : one) other.push_back(x - 0.25);
  const BootstrapReport report = bootstrapPairedDifference(one, other, mean, {.resamples = 200}, random);
  EXPECT_NEAR(report.interval.low, 0.25, 1e-14);
  EXPECT_NEAR(report.interval.high, 0.25, 1e-14);
}

TEST(Bootstrap, SameSeedSameReport) {
  const auto run = [](std::uint64_t seed) {
    base::Random random(seed, "bootstrap");
    return bootstrap(kMichelson, median, {.resamples = 100}, random).replicates;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(Bootstrap, OnePieceIsARecordingWithoutGaps) {
  const auto replicates = [](const Pieces& pieces) {
    base::Random random(7);
    return bootstrap(kMichelson, mean, {.resamples = 50, .pieces = pieces}, random).replicates;
  };
  EXPECT_EQ(replicates({std::size(kMichelson)}), replicates({}));
}

TEST(Bootstrap, DefaultBlockLengthIsTheCubeRoot) {
  EXPECT_EQ(defaultBlockLength(1), 1U);
  EXPECT_EQ(defaultBlockLength(8), 2U);
  EXPECT_EQ(defaultBlockLength(1000), 10U);
  EXPECT_EQ(defaultBlockLength(200000), 58U);  // 58.48
}

TEST(Bootstrap, RefusesWhatHasNoAnswer) {
  base::Random random(1);
  const std::vector<double> three = {1.0, 2.0, 3.0};
  const std::vector<double> broken = {1.0, std::numeric_limits<double>::quiet_NaN()};
  const auto none = [](std::span<const double>) { return std::nan(""); };
  EXPECT_THROW(bootstrap({}, mean, {}, random), base::InputError);
  EXPECT_THROW(bootstrap(broken, mean, {}, random), base::InputError);
  EXPECT_THROW(bootstrap(three, none, {}, random), base::InputError);
  EXPECT_THROW(bootstrap(three, mean, {.block_length = 4}, random), base::InputError);
  EXPECT_THROW(bootstrap(three, mean, {.resamples = 1}, random), base::InputError);
  EXPECT_THROW(bootstrap(three, mean, {.pieces = {1, 1}}, random), base::InputError);
  EXPECT_THROW(bootstrap(three, mean, {.pieces = {3, 0}}, random), base::InputError);
  for (const std::size_t length : {0U, 2U, 5U})
    EXPECT_THROW(bootstrap(three, mean, {.pieces = {length}}, random), base::InputError) << length;
  EXPECT_THROW(bootstrap(three, mean, {.confidence = 1.5}, random), base::InputError);
  EXPECT_THROW(bootstrapDifference(three, broken, mean, {}, random), base::InputError);
  EXPECT_THROW(bootstrapPairedDifference(three, kMichelson, mean, {}, random), base::InputError);
}

}  // namespace
}  // namespace capstan::stats
