#include "core/stats/block_length.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"

namespace capstan::stats {
namespace {

std::vector<double> autoregression(double phi, std::size_t n, base::Random& random) {
  std::vector<double> values(n);
  double x = random.normal() / std::sqrt(1.0 - phi * phi);
  for (double& value : values) value = x = phi * x + random.normal();
  return values;
}

// Of an AR(1) process R_k = R_0 φ^|k|, so G = 2 φ/(1 − φ)² R_0 and g = (1 + φ)/(1 − φ) R_0, whence
// b = (6 φ² / (1 − φ²)²)^(1/3) n^(1/3).
TEST(BlockLength, OfAnAutoregressionIsItsClosedForm) {
  constexpr std::size_t kSamples = 20000;
  for (const double phi : {0.5, 0.8, 0.9}) {
    const double root = 1.0 - phi * phi;
    const double exact = std::cbrt(6.0 * phi * phi / (root * root) * static_cast<double>(kSamples));
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      base::Random random(seed, "autoregression");
      sum += static_cast<double>(optimalBlockLength(autoregression(phi, kSamples, random)));
    }
    EXPECT_NEAR(sum / 20.0 / exact, 1.0, 0.1) << phi;
  }
}

TEST(BlockLength, OfIndependentSamplesIsShort) {
  base::Random random(4, "white");
  EXPECT_LE(optimalBlockLength(autoregression(0.0, 20000, random)), 6U);
}

TEST(BlockLength, StaysWithinTheSamples) {
  std::vector<double> slow;
  for (int i = 0; i < 300; ++i) slow.push_back(std::sin(0.01 * i));
  EXPECT_LE(optimalBlockLength(slow), 52U);  // 3 √300
  EXPECT_GE(optimalBlockLength(slow), 10U);
  EXPECT_EQ(optimalBlockLength(std::vector<double>(100, 2.0)), 1U);
  EXPECT_EQ(optimalBlockLength(std::vector<double>{1.0, 2.0, 3.0}), 1U);
}

TEST(BlockLength, RefusesWhatIsNotFinite) {
  EXPECT_THROW(optimalBlockLength({}), base::InputError);
  const std::vector<double> broken{1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(optimalBlockLength(broken), base::InputError);
}

}  // namespace
}  // namespace capstan::stats
