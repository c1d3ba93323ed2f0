#include "core/estimation/consistency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/estimation/occlusion_gate.h"
#include "core/stats/chi_square.h"

namespace capstan::estimation {
namespace {

// Quantiles from the printed tables of Abramowitz and Stegun, table 26.8.
TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(stats::chiSquareQuantile(1, 0.95), 3.84146, 1e-5);
  EXPECT_NEAR(stats::chiSquareQuantile(3, 0.95), 7.81473, 1e-5);
  EXPECT_NEAR(stats::chiSquareQuantile(3, 0.999), 16.266, 1e-3);
}

TEST(ChiSquare, BandIsForTheMean) {
  const Band one = chiSquareBand(10, 1);
  EXPECT_NEAR(10.0 * one.low, 3.24697, 1e-5);
  EXPECT_NEAR(10.0 * one.high, 20.4831, 1e-4);
  const Band same = chiSquareBand(2, 5);
  EXPECT_DOUBLE_EQ(same.low, one.low);
  EXPECT_DOUBLE_EQ(same.high, one.high);
  const Band many = chiSquareBand(6, 200);  // normal approximation 1 ± 1.96 sqrt(2 / 1200)
  EXPECT_NEAR(many.low, 0.9216, 2e-3);
  EXPECT_NEAR(many.high, 1.0816, 2e-3);
}

TEST(OcclusionGate, ShutsBeyondItsThresholdAndForNaN) {
  const OcclusionGate gate(3, 0.999);
  EXPECT_TRUE(gate.isOpen(0.0));
  EXPECT_TRUE(gate.isOpen(16.2));
  EXPECT_FALSE(gate.isOpen(16.3));
  EXPECT_FALSE(gate.isOpen(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Consistency, NeesIsTheMahalanobisDistance) {
  Lower<2> root;
  root << 2.0, 0.0, 1.0, 3.0;  // covariance [4 2; 2 10], inverse [10 −2; −2 4] / 36
  EXPECT_DOUBLE_EQ(nees<2>({1.0, 2.0}, root), (10.0 - 8.0 + 16.0) / 36.0);
}

TEST(ConsistencyWindow, HoldsTheLastValuesOnly) {
  ConsistencyWindow window(2, 3);
  EXPECT_TRUE(std::isnan(window.mean()));
  EXPECT_TRUE(window.consistent());
  for (const double value : {100.0, 2.0, 4.0, 6.0}) window.add(value);
  window.add(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(window.count(), 3);
  EXPECT_DOUBLE_EQ(window.mean(), 4.0 / 2.0);
  window.reset();
  EXPECT_EQ(window.count(), 0);
}

TEST(ConsistencyWindow, JudgesChiSquareNumbersRightly) {
  base::Random random(8);
  constexpr int kTrials = 1000, kWindow = 50;
  int inside = 0, inside_wide = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    ConsistencyWindow window(3, kWindow), wide(3, kWindow);
    for (int i = 0; i < kWindow; ++i) {
      double sum = 0.0;
      for (int d = 0; d < 3; ++d) sum += std::pow(random.normal(), 2);
      window.add(sum);
      wide.add(1.5 * sum);
    }
    inside += window.consistent();
    inside_wide += wide.consistent();
  }
  EXPECT_NEAR(inside / double(kTrials), 0.95, 3.0 * std::sqrt(0.95 * 0.05 / kTrials));
  EXPECT_LT(inside_wide, 0.1 * kTrials);
}

}  // namespace
}  // namespace capstan::estimation
