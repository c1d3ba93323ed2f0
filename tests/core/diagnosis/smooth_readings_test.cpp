// Smoothed readings are nearer the motion than the readings, and never further from them than their noise.
#include "core/diagnosis/evidence/smooth_readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace capstan::diagnosis {
namespace {

constexpr double kCount = 1.5e-3;
const double kNoise = kCount / std::sqrt(12.0);

std::vector<double> swing(std::size_t n, double amplitude, double rate) {
  std::vector<double> x;
  for (std::size_t k = 0; k < n; ++k) x.push_back(2.0 + amplitude * std::sin(rate * static_cast<double>(k)));
  return x;
}

std::vector<double> rounded(std::vector<double> x) {
  for (double& value : x) value = kCount * std::round(value / kCount);
  return x;
}

double rmsBetween(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) squares += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(squares / static_cast<double>(a.size()));
}

TEST(SmoothReadings, LosesTheStepsOfAnEncoder) {
  const std::vector<double> motion = swing(20000, 0.8, 2e-3), readings = rounded(motion);
  const std::vector<double> smooth = smoothReadings(readings, kNoise);
  EXPECT_NEAR(rmsBetween(readings, motion), kNoise, 0.05 * kNoise);
  EXPECT_LT(rmsBetween(smooth, motion), kNoise / 3.0);
  EXPECT_LT(rmsBetween(smooth, readings), 1.1 * kNoise);
}

TEST(SmoothReadings, LosesWhiteNoise) {
  base::Random random(1, "smooth readings");
  const std::vector<double> motion = swing(8000, 0.02, 4e-3);
  std::vector<double> readings = motion;
  for (double& x : readings) x += random.normal(0.0, kNoise);
  EXPECT_LT(rmsBetween(smoothReadings(readings, kNoise), motion), kNoise / 3.0);
}

TEST(SmoothReadings, KeepsMotionThatIsFast) {
  const std::vector<double> motion = swing(4000, 200.0 * kCount, 0.15), readings = rounded(motion);
  const std::vector<double> smooth = smoothReadings(readings, kNoise);
  EXPECT_LT(rmsBetween(smooth, motion), 1.1 * kNoise);
}

/// Rest, 50 readings of constant acceleration, even speed: no reading's worth of it is lost.
TEST(SmoothReadings, KeepsAStart) {
  constexpr double kAcceleration = 8e-6;
  std::vector<double> motion;
  for (int k = 0; k < 4000; ++k) {
    const double since = std::max(k - 2000, 0), start = std::min(since, 50.0);
    motion.push_back(0.5 * kAcceleration * start * start + 50.0 * kAcceleration * (since - start));
  }
  const std::vector<double> smooth = smoothReadings(rounded(motion), kNoise);
  for (std::size_t k = 0; k < motion.size(); ++k) ASSERT_NEAR(smooth[k], motion[k], 1.5 * kCount) << k;
}

TEST(SmoothReadings, KeepsAStartInTheLastReadings) {
  std::vector<double> motion(2000, 0.0);
  for (int k = 0; k < 45; ++k) motion.push_back(0.5 * 8e-6 * k * k);
  const std::vector<double> smooth = smoothReadings(rounded(motion), kNoise);
  for (std::size_t k = 0; k < motion.size(); ++k) ASSERT_NEAR(smooth[k], motion[k], 1.5 * kCount) << k;
}

TEST(SmoothReadings, LeavesAloneWhatHasNoNoiseOrIsTooShort) {
  const std::vector<double> motion = swing(100, 0.8, 0.01);
  EXPECT_EQ(smoothReadings(motion, 0.0), motion);
  const std::vector<double> seven = swing(7, 0.8, 0.01);
  EXPECT_EQ(smoothReadings(seven, kNoise), seven);
  EXPECT_TRUE(smoothReadings({}, kNoise).empty());
}

TEST(SmoothReadings, KeepsWhatStandsStill) {
  const std::vector<double> still(500, 0.25);
  for (const double x : smoothReadings(still, kNoise)) ASSERT_NEAR(x, 0.25, 1e-12);
}

}  // namespace
}  // namespace capstan::diagnosis
