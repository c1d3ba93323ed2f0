// Noise and quantisation that were put in come out; derivatives agree with those of known functions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/diagnosis/evidence/channel_noise.h"
#include "core/diagnosis/evidence/smooth_derivative.h"

namespace capstan::diagnosis {
namespace {

constexpr double kStep = 1e-3;

/// A motion of 0.3 Hz and 1.7 Hz over `n` milliseconds.
std::vector<double> motion(std::size_t n) {
  std::vector<double> x;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = kStep * static_cast<double>(i);
    x.push_back(0.5 * std::sin(2.0 * t) + 0.1 * std::cos(10.7 * t));
  }
  return x;
}

std::vector<double> rounded(std::vector<double> x, double step) {
  for (double& value : x) value = step * std::round(value / step);
  return x;
}

TEST(ChannelNoise, FindsTheStepOfAnEncoder) {
  const double count = 2.0 * std::numbers::pi / 4000.0;
  EXPECT_NEAR(quantisationStep(rounded(motion(5000), count)), count, 1e-12);
  // As a table of six decimals has it.
  EXPECT_NEAR(quantisationStep(rounded(rounded(motion(5000), count), 1e-6)), count, 2e-6);
}

TEST(ChannelNoise, SaysNoStepOfContinuousOrConstantSamples) {
  EXPECT_EQ(quantisationStep(motion(5000)), 0.0);
  EXPECT_EQ(quantisationStep(std::vector<double>(500, 0.25)), 0.0);
  EXPECT_EQ(whiteNoise(std::vector<double>(500, 0.25)), 0.0);
}

TEST(ChannelNoise, TellsWhiteNoiseFromMotion) {
  base::Random random(4);
  for (const double sigma : {1e-6, 1e-4, 1e-2}) {
    std::vector<double> x = motion(20000);
    for (double& value : x) value += random.normal(0.0, sigma);
    EXPECT_NEAR(whiteNoise(x), sigma, 0.05 * sigma);
  }
}

/// A camera's fifteen pictures a second: motion is fast, second differences alone would see it as noise.
TEST(ChannelNoise, IsTheNoiseAloneOfSlowlySampledMotion) {
  base::Random random(5);
  std::vector<double> x;
  const double sigma = 2e-4;
  double second = 0.0;
  for (int i = 0; i < 900; ++i) {
    const double t = i / 15.0;
    x.push_back(0.02 * std::sin(2.5 * t) + random.normal(0.0, sigma));
  }
  for (std::size_t i = 2; i < x.size(); ++i) second += std::pow(x[i] - 2.0 * x[i - 1] + x[i - 2], 2);
  second = std::sqrt(second / 6.0 / static_cast<double>(x.size() - 2));
  EXPECT_GT(second, 1.2 * sigma);
  EXPECT_NEAR(whiteNoise(x), sigma, 0.1 * sigma);
}

/// The least of several estimates would be some per cent too small.
TEST(ChannelNoise, IsOnAverageRightForAFewHundredSamples) {
  constexpr int kTimes = 200;
  base::Random random(9);
  double sum = 0.0;
  for (int time = 0; time < kTimes; ++time) {
    std::vector<double> x(400);
    for (double& value : x) value = random.normal(0.0, 1e-3);
    sum += whiteNoise(x) / kTimes;
  }
  EXPECT_NEAR(sum, 1e-3, 0.02e-3);
}

TEST(ChannelNoise, OutliersAndRestsDoNotCount) {
  base::Random random(6);
  std::vector<double> x = motion(10000);
  for (double& value : x) value += random.normal(0.0, 1e-4);
  for (std::size_t i = 100; i < x.size(); i += 500) x[i] += 0.05;
  EXPECT_NEAR(whiteNoise(x), 1e-4, 1e-5);
  std::fill(x.begin() + 3000, x.begin() + 9000, x[3000]);
  EXPECT_NEAR(whiteNoise(x), 1e-4, 1.5e-5);
}

TEST(ChannelNoise, FloorIsNeverBelowRounding) {
  EXPECT_DOUBLE_EQ((ChannelNoise{std::sqrt(12.0), 0.5}.floor()), 1.0);
  EXPECT_DOUBLE_EQ((ChannelNoise{std::sqrt(12.0), 2.0}.floor()), 2.0);
}

TEST(SmoothDerivative, OfACubicIsExactToTheEnds) {
  std::vector<double> x;
  const auto at = [](double t) { return 1.0 - 2.0 * t + 3.0 * t * t + 0.5 * t * t * t; };
  for (int i = 0; i < 60; ++i) x.push_back(at(0.1 * i));
  const auto first = smoothDerivative(x, 0.1, 5), second = smoothDerivative(x, 0.1, 5, 2);
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    EXPECT_NEAR(first[static_cast<std::size_t>(i)], -2.0 + 6.0 * t + 1.5 * t * t, 1e-9);
    EXPECT_NEAR(second[static_cast<std::size_t>(i)], 6.0 + 3.0 * t, 1e-8);
  }
}

TEST(SmoothDerivative, FewSamplesGiveWhatTheyCarry) {
  const std::vector<double> line = {1.0, 3.0};
  EXPECT_NEAR(smoothDerivative(line, 0.5, 4)[1], 4.0, 1e-12);
  EXPECT_EQ(smoothDerivative(std::vector<double>{7.0}, 0.5, 4), std::vector<double>{0.0});
  const std::vector<double> parabola = {0.0, 1.0, 4.0};
  EXPECT_NEAR(smoothDerivative(parabola, 1.0, 4, 2)[0], 2.0, 1e-12);
}

/// Of a motor encoder at 1 kHz, 10 ms to either side: a fifth of the error of the plain central difference.
TEST(SmoothDerivative, TamesQuantisation) {
  const double count = 2.0 * std::numbers::pi / 4000.0;
  std::vector<double> x, truth;
  for (int i = 0; i < 4000; ++i) {
    const double t = kStep * i;
    x.push_back(count * std::round(30.0 * std::sin(3.0 * t) / count));
    truth.push_back(90.0 * std::cos(3.0 * t));
  }
  const auto slope = smoothDerivative(x, kStep, 10);
  double smooth = 0.0, plain = 0.0;
  for (std::size_t i = 10; i + 10 < x.size(); ++i) {
    smooth += std::pow(slope[i] - truth[i], 2);
    plain += std::pow((x[i + 1] - x[i - 1]) / (2.0 * kStep) - truth[i], 2);
  }
  EXPECT_LT(smooth, 0.04 * plain);
}

}  // namespace
}  // namespace capstan::diagnosis
