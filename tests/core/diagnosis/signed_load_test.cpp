// Signs of a load whose sensor measures its magnitude, and lines in the spectrum of a residual: on numbers
// made by formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/fit/chain_simulation.h"
#include "core/diagnosis/selection/spectral_line.h"

namespace capstan::diagnosis {
namespace {

TEST(WithSigns, turnsTheSignWhereTheMagnitudeTouchesZero) {
  std::vector<double> magnitude, load;
  base::Random random(7);
  for (int k = 0; k < 20000; ++k) {
    const double x = std::sin(2.0 * std::numbers::pi * k / 6000.0 + 0.7) +
                     0.2 * std::sin(2.0 * std::numbers::pi * k / 2300.0);
    load.push_back(x);
    magnitude.push_back(std::abs(x + random.normal(0.0, 0.002)));
  }
  const std::vector<double> measured = withSigns(magnitude);
  int wrong = 0;
  for (std::size_t k = 0; k < load.size(); ++k)
    wrong += std::abs(load[k]) > 0.1 && measured[k] * load[k] < 0.0;
  EXPECT_EQ(wrong, 0);
}

TEST(WithSigns, turnsOnceWhereNoiseLingersAboutZero) {
  std::vector<double> magnitude, load;
  base::Random random(8);
  for (int k = 0; k < 20000; ++k) {
    load.push_back(-0.3 * std::sin(2.0 * std::numbers::pi * k / 9000.0 - 0.9));
    magnitude.push_back(std::abs(load.back() + random.normal(0.0, 0.005)));
  }
  const std::vector<double> measured = withSigns(magnitude);
  const double start = load.front() < 0.0 ? -1.0 : 1.0;  // nobody can know
  int wrong = 0;
  for (std::size_t k = 0; k < load.size(); ++k)
    wrong += std::abs(load[k]) > 0.05 && start * measured[k] * load[k] < 0.0;
  EXPECT_EQ(wrong, 0);
}

TEST(WithSigns, findsTheTurnsOfALoadNotMuchLargerThanItsNoise) {
  std::vector<double> magnitude, load;
  base::Random random(9);
  for (int k = 0; k < 20000; ++k) {
    load.push_back(0.02 * std::sin(2.0 * std::numbers::pi * k / 4400.0 + 0.5));
    magnitude.push_back(std::abs(load.back() + random.normal(0.0, 0.005)));
  }
  const std::vector<double> measured = withSigns(magnitude);
  int wrong = 0;
  for (std::size_t k = 0; k < load.size(); ++k)
    wrong += std::abs(load[k]) > 0.01 && measured[k] * load[k] < 0.0;
  EXPECT_EQ(wrong, 0);
}

Channel channelOf(double line, double frequency) {
  Channel channel;
  channel.name = "q1";
  base::Random random(9);
  double slow = 0.0;
  for (int k = 0; k < 3000; ++k) {
    slow = 0.98 * slow + random.normal(0.0, 1.0);
    channel.t.push_back(0.01 * k);
    channel.residual.push_back(slow + random.normal(0.0, 1.0) +
                               line * std::sin(2.0 * std::numbers::pi * frequency * 0.01 * k));
  }
  return channel;
}

TEST(SpectralLine, findsAVibrationInColouredNoiseAndNoneWhereThereIsNone) {
  EXPECT_FALSE(spectralLine(channelOf(0.0, 0.0)));
  const auto line = spectralLine(channelOf(1.5, 7.3));
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->frequency, 7.3, 0.05);
  EXPECT_NEAR(line->amplitude, 1.5, 0.4);
  EXPECT_LT(line->p_value, kLineChance);
}

}  // namespace
}  // namespace capstan::diagnosis
