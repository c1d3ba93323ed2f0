#include "core/stats/running_rms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capstan::stats {
namespace {

// Σ k², k = 1…n, is n(n+1)(2n+1)/6.
TEST(RunningRms, AgreesWithTheClosedForm) {
  RunningRms<2> rms;
  const int n = 1000;
  for (int k = 1; k <= n; ++k) EXPECT_TRUE(rms.add({k, -2.0 * k}));
  const double expected = std::sqrt((n + 1.0) * (2.0 * n + 1.0) / 6.0);
  EXPECT_DOUBLE_EQ(rms.value()(0), expected);
  EXPECT_DOUBLE_EQ(rms.value()(1), 2.0 * expected);
  EXPECT_EQ(rms.count(), 1000U);
}

TEST(RunningRms, LeavesOutWhatIsNotFinite) {
  RunningRms<2> rms;
  EXPECT_FALSE(rms.add({std::numeric_limits<double>::quiet_NaN(), 1.0}));
  EXPECT_FALSE(rms.add({1.0, std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(std::isnan(rms.value()(0)));
  EXPECT_TRUE(rms.add({3.0, 4.0}));
  EXPECT_EQ(rms.value()(0), 3.0);
  EXPECT_EQ(rms.count(), 1U);
}

}  // namespace
}  // namespace capstan::stats
