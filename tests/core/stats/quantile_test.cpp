#include "core/stats/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace capstan::stats {
namespace {

// Values of R 4: quantile(c(3,1,4,1,5,9,2,6), c(0,.05,.25,.5,.75,.95,1)), type 7, worked by hand from
// the sorted sample 1 1 2 3 4 5 6 9: h = 7 p.
TEST(Quantile, AgreesWithHyndmanFanType7) {
  const std::vector<double> sample = {3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_DOUBLE_EQ(quantile(sample, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.05), 1.0);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.75), 5.25);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.95), 7.95);
  EXPECT_DOUBLE_EQ(quantile(sample, 1.0), 9.0);
}

TEST(Quantile, OneValueIsEveryQuantile) {
  const std::vector<double> sample = {-2.5};
  for (const double share : {0.0, 0.3, 1.0}) EXPECT_EQ(quantile(sample, share), -2.5);
}

TEST(Quantile, LeavesOutNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> sample = {nan, 2.0, nan, 1.0, 3.0};
  EXPECT_EQ(median(sample), 2.0);
  EXPECT_TRUE(std::isnan(median(std::vector<double>{nan})));
  EXPECT_TRUE(std::isnan(median(std::vector<double>{})));
}

TEST(Quantile, InfinityDoesNotSpreadToItsNeighbours) {
  const std::vector<double> sample = {1.0, 2.0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(median(sample), 2.0);
  EXPECT_EQ(quantile(sample, 1.0), std::numeric_limits<double>::infinity());
}

TEST(Quantile, SeveralComeInTheOrderAsked) {
  const std::vector<double> sample = {0, 10};
  const std::vector<double> shares = {0.9, 0.1};
  EXPECT_EQ(quantiles(sample, shares), (std::vector<double>{9.0, 1.0}));
}

}  // namespace
}  // namespace capstan::stats
