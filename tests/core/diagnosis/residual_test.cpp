// Statistics of residuals whose making is known.
#include "core/diagnosis/residuals/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/diagnosis/residuals/decimated_residual.h"
#include "tests/core/diagnosis/synthetic.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Residual, IsWhatIsMeasuredMinusWhatIsSimulatedWhereItCounts) {
  Scene s = scene(2, 1.0, 1);
  for (std::size_t i = 0; i < s.evidence.rows(); ++i) s.evidence.q[1][i] += 0.25;
  s.evidence.q[1][10] = kNaN;
  s.evidence.exclusions[20] = kGap;
  s.evidence.tip = {{0.1004, 100.4, {1.0, 2.0, 3.0}, true}, {0.5, 500.0, {9.0, 9.0, 9.0}, false}};
  s.evidence.noise.tip[2] = {0.0, 2e-3};
  s.simulated.tip = {{1.0, 1.5, 1.0}, {0.0, 0.0, 0.0}};
  const std::vector<Channel> channels = residualOf(s.evidence, s.simulated, s.robot);
  ASSERT_EQ(channels.size(), 5U);
  EXPECT_EQ(channels[1].name, "q2");
  EXPECT_EQ(channels[1].unit, "rad");
  EXPECT_EQ(channels[1].size(), s.evidence.rows() - 2);
  for (const double e : channels[1].residual) EXPECT_NEAR(e, 0.25, 1e-12);
  EXPECT_EQ(channels[1].row[10], 11.0);
  EXPECT_NEAR(channels[1].period, 1e-3, 1e-12);
  EXPECT_EQ(channels[4].name, "tip z");
  EXPECT_EQ(channels[4].axis, 2);
  EXPECT_EQ(channels[4].noise, 2e-3);
  ASSERT_EQ(channels[4].size(), 1U);
  EXPECT_EQ(channels[4].residual[0], 2.0);
  EXPECT_EQ(channels[3].residual[0], 0.5);
}

TEST(Residual, RefusesASimulationOfAnotherRecordingOrOneThatRanAway) {
  Scene s = scene(2, 1.0, 1);
  SimulatedMotion other = s.simulated;
  other.q.pop_back();
  EXPECT_THROW(residualOf(s.evidence, other, s.robot), base::InputError);
  other = s.simulated;
  other.q[0].pop_back();
  EXPECT_THROW(residualOf(s.evidence, other, s.robot), base::InputError);
  s.evidence.tip = {{0.1, 100.0, {1.0, 2.0, 3.0}, true}};
  EXPECT_THROW(residualOf(s.evidence, s.simulated, s.robot), base::InputError);
  s.evidence.tip.clear();
  s.simulated.q[1][500] = std::numeric_limits<double>::infinity();
  try {
    residualOf(s.evidence, s.simulated, s.robot);
    ADD_FAILURE() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "simulated q2");
    EXPECT_EQ(error.fault().value, "inf at 0.500 s");
  }
}

Channel noisy(double offset, double sigma, double noise, double memory, std::uint64_t seed) {
  Scene s = scene(1, 60.0, seed);
  base::Random random(seed, "noise");
  const auto e = slowNoise(random, s.evidence.rows(), 1e-3, memory, sigma);
  for (std::size_t i = 0; i < e.size(); ++i) s.evidence.q[0][i] += offset + e[i];
  s.evidence.noise.q[0] = {0.0, noise};
  return residualOf(s.evidence, s.simulated, s.robot)[0];
}

TEST(ChannelStatistics, OfWhiteNoise) {
  const Channel channel = noisy(0.0, 0.01, 0.01, 1e-6, 3);
  const ChannelStatistics found = statisticsOf(channel);
  EXPECT_NEAR(found.rms, 0.01, 1e-4);
  EXPECT_LT(found.beyond_noise, 0.03);
  EXPECT_GT(found.whiteness.p_value, 1e-3);
  EXPECT_GT(found.effective_samples, 0.5 * static_cast<double>(channel.size()));
  // Fit by its definition, over the very numbers.
  double errors = 0.0, swing = 0.0, mean = 0.0;
  for (const double y : channel.measured) mean += y / static_cast<double>(channel.size());
  for (std::size_t i = 0; i < channel.size(); ++i)
    errors += channel.residual[i] * channel.residual[i], swing += std::pow(channel.measured[i] - mean, 2);
  EXPECT_NEAR(found.fit, 100.0 * (1.0 - std::sqrt(errors / swing)), 1e-9);
}

TEST(ChannelStatistics, OfASlowResidual) {
  const Channel channel = noisy(0.02, 0.01, 0.001, 0.25, 4);
  const ChannelStatistics found = statisticsOf(channel);
  EXPECT_NEAR(found.mean, 0.02, 0.004);
  EXPECT_NEAR(found.rms, std::hypot(0.02, 0.01), 0.003);
  EXPECT_NEAR(found.beyond_noise, 1.0 - 1e-6 / (found.rms * found.rms), 1e-12);
  EXPECT_LT(found.whiteness.p_value, 1e-6);
  // A first-order process of memory τ is worth T / 2τ samples for its mean: 120 in a minute.
  EXPECT_GT(found.effective_samples, 60.0);
  EXPECT_LT(found.effective_samples, 240.0);
}

TEST(ChannelStatistics, OfAChannelThatNeverMoves) {
  Scene s = scene(1, 1.0, 1);
  std::fill(s.evidence.q[0].begin(), s.evidence.q[0].end(), 1.0);
  s.simulated.q = s.evidence.q;
  const ChannelStatistics found = statisticsOf(residualOf(s.evidence, s.simulated, s.robot)[0]);
  EXPECT_TRUE(std::isnan(found.fit));
  EXPECT_TRUE(std::isnan(found.whiteness.q));
  EXPECT_EQ(found.rms, 0.0);
  EXPECT_EQ(found.beyond_noise, 0.0);
}

TEST(TimeBlocks, AreLongerThanTheMemoryAndNumberedWithoutGaps) {
  const Channel slow = noisy(0.0, 0.01, 0.001, 0.25, 5), fast = noisy(0.0, 0.01, 0.001, 1e-6, 5);
  const TimeBlocks blocks = timeBlocks(slow);
  EXPECT_GT(blocks.length, 0.5);
  EXPECT_LE(blocks.length, 3.0 + 1e-9);
  EXPECT_LT(timeBlocks(fast).length, 0.3 * blocks.length);
  for (std::size_t i = 1; i < blocks.index.size(); ++i) {
    ASSERT_LE(blocks.index[i] - blocks.index[i - 1], 1U);
    ASSERT_LT(slow.t[i] - blocks.begin[blocks.index[i]], blocks.length + 1e-6);
  }
  EXPECT_EQ(blocks.index.back() + 1, blocks.count);
}

}  // namespace
}  // namespace capstan::diagnosis
