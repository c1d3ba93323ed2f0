#include "core/stats/rms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "tests/core/stats/michelson.h"

namespace capstan::stats {
namespace {

/// NIST StRD "NumAcc": 1001 values, `offset` + 0.2 first, then + 0.1 and + 0.3 in turn.
std::vector<double> numAcc(double first, double low, double high) {
  std::vector<double> values = {first};
  for (int k = 0; k < 500; ++k) values.insert(values.end(), {low, high});
  return values;
}

// Certified values are of the decimal numbers; of the doubles next to them, off by up to 3e-14 each, exact
// arithmetic (python3: statistics.stdev) gives 0.07901054781905066.
TEST(Rms, MichelsonHasNistsCertifiedMoments) {
  EXPECT_NEAR(mean(kMichelson), 299.852400000000, 1e-12);
  EXPECT_NEAR(standardDeviation(kMichelson), 0.0790105478190518, 3e-14);
  EXPECT_DOUBLE_EQ(standardDeviation(kMichelson), 0.07901054781905066);
}

// Certified: mean 10000000.2, deviation 0.1 of the decimal numbers. Of the doubles next to them, in exact
// arithmetic: python3 -c "import statistics as s;
// print(repr(s.stdev([10000000.2]+[10000000.1,10000000.3]*500)))"
TEST(Rms, OffsetsCostNoDigits) {
  const std::vector<double> of4 = numAcc(10000000.2, 10000000.1, 10000000.3);
  EXPECT_EQ(mean(of4), 10000000.2);
  EXPECT_DOUBLE_EQ(standardDeviation(of4), 0.10000000055879354);
  EXPECT_NEAR(standardDeviation(of4), 0.1, 1e-9);
  const std::vector<double> of3 = numAcc(1000000.2, 1000000.1, 1000000.3);
  EXPECT_EQ(mean(of3), 1000000.2);
  EXPECT_DOUBLE_EQ(standardDeviation(of3), 0.1000000000349246);
}

TEST(Rms, IsTheRootOfTheMeanSquare) {
  EXPECT_DOUBLE_EQ(rms(std::vector<double>{3.0, -4.0}), std::sqrt(12.5));
  EXPECT_EQ(rms(std::vector<double>{-2.0}), 2.0);
  EXPECT_EQ(rms(std::vector<double>{0.0, 0.0}), 0.0);
}

// 1 and a million times 2^−30: each square is lost beside the sum when added plainly, together they are not.
TEST(Rms, SmallSquaresBesideALargeOneCount) {
  std::vector<double> values(1 << 20, std::ldexp(1.0, -30));
  values.insert(values.begin(), 1.0);
  const double squares = 1.0 + std::ldexp(1.0, -40);
  EXPECT_DOUBLE_EQ(rms(values) * rms(values) * static_cast<double>(values.size()), squares);
}

TEST(Rms, AnyMagnitude) {
  for (const double unit : {1e-300, 1.0, 1e300}) {
    const std::vector<double> values = {1.0 * unit, 2.0 * unit, 3.0 * unit, 6.0 * unit};
    EXPECT_NEAR(rms(values) / unit, std::sqrt(12.5), 1e-14);
    EXPECT_NEAR(mean(values) / unit, 3.0, 1e-14);
    EXPECT_NEAR(standardDeviation(values) / unit, std::sqrt(14.0 / 3.0), 1e-14);
  }
}

TEST(Rms, TheSmallestAndTheLargestDoubles) {
  for (const double x : {std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()}) {
    EXPECT_NEAR(rms(std::vector<double>{x, -x, x}) / x, 1.0, 1e-15);
    EXPECT_EQ(mean(std::vector<double>{x, x, x}), x);
  }
}

TEST(Rms, MomentsAreTheThreeAtOnce) {
  const Moments all = moments(kMichelson);
  EXPECT_EQ(all.n, 100U);
  EXPECT_EQ(all.mean, mean(kMichelson));
  EXPECT_EQ(all.variance, variance(kMichelson));
  EXPECT_DOUBLE_EQ(all.standardDeviation(), standardDeviation(kMichelson));
}

TEST(Rms, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(rms({}), base::InputError);
  EXPECT_THROW(mean({}), base::InputError);
  EXPECT_THROW(variance(std::vector<double>{1.0}), base::InputError);
  EXPECT_THROW(moments(std::vector<double>{1.0}), base::InputError);
  try {
    rms(std::vector<double>{1.0, 2.0, std::numeric_limits<double>::quiet_NaN()});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "rms[2]");
    EXPECT_EQ(error.fault().value, "nan");
  }
}

}  // namespace
}  // namespace capstan::stats
