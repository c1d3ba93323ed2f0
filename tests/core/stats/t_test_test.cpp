#include "core/stats/t_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/stats/student_t.h"

namespace capstan::stats {
namespace {

// Student's (1908) own example, extra hours of sleep by two drugs; R's data set `sleep`.
const std::vector<double> kFirstDrug = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kSecondDrug = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

// R 4.2.2: x <- sleep$extra[1:10]; y <- sleep$extra[11:20]; t.test(x, y, paired=TRUE)
TEST(TTest, PairedAgreesWithR) {
  const TTest test = pairedTTest(kFirstDrug, kSecondDrug);
  EXPECT_NEAR(test.t, -4.06212768338203656, 1e-14);
  EXPECT_EQ(test.degrees_of_freedom, 9.0);
  EXPECT_NEAR(test.p_value, 0.00283289019738427, 1e-16);
  EXPECT_NEAR(test.log10_p, std::log10(0.00283289019738427), 1e-14);
  EXPECT_NEAR(test.mean_difference, -1.58, 1e-15);
  EXPECT_NEAR(test.standard_error, 0.38895872388839520, 1e-15);
  EXPECT_NEAR(test.interval.low, -2.45988576327698238, 1e-13);
  EXPECT_NEAR(test.interval.high, -0.70011423672301754, 1e-13);
}

// R 4.2.2: t.test(x, y, var.equal=TRUE)
TEST(TTest, PooledAgreesWithR) {
  const TTest test = pooledTTest(kFirstDrug, kSecondDrug);
  EXPECT_NEAR(test.t, -1.86081346748685283, 1e-14);
  EXPECT_EQ(test.degrees_of_freedom, 18.0);
  EXPECT_NEAR(test.p_value, 0.07918671421593818, 1e-15);
  EXPECT_NEAR(test.interval.low, -3.36387403228759840, 1e-13);
  EXPECT_NEAR(test.interval.high, 0.20387403228759859, 1e-13);
}

// R 4.2.2: t.test(x, y) and t.test(x, y, conf.level=0.99)
TEST(TTest, WelchAgreesWithR) {
  const TTest test = welchTTest(kFirstDrug, kSecondDrug);
  EXPECT_NEAR(test.t, -1.86081346748685306, 1e-14);
  EXPECT_NEAR(test.degrees_of_freedom, 17.77647351617849836, 1e-12);
  EXPECT_NEAR(test.p_value, 0.07939414018735817, 1e-15);
  EXPECT_NEAR(test.interval.low, -3.36548323071171041, 1e-13);
  EXPECT_NEAR(test.interval.high, 0.20548323071171018, 1e-13);
  const TTest at99 = welchTTest(kFirstDrug, kSecondDrug, 0.99);
  EXPECT_NEAR(at99.interval.low, -4.02763291991904016, 1e-13);
  EXPECT_NEAR(at99.interval.high, 0.86763291991903957, 1e-13);
}

// NIST/SEMATECH e-Handbook 1.3.5.3, AUTO83B.DAT: miles per gallon of 249 American and 79 Japanese cars, from
// the moments printed there. t = −12.62059, ν = 326; its R listing gives the interval −11.947653 to
// −8.725216.
TEST(TTest, PooledAgreesWithNistsCars) {
  const Moments american = {249, 20.14458, 6.41470 * 6.41470};
  const Moments japanese = {79, 30.48101, 6.10771 * 6.10771};
  const TTest test = pooledTTest(american, japanese);
  EXPECT_NEAR(test.t, -12.62059, 1e-5);
  EXPECT_EQ(test.degrees_of_freedom, 326.0);
  EXPECT_NEAR(test.interval.low, -11.947653, 1e-5);
  EXPECT_NEAR(test.interval.high, -8.725216, 1e-5);
}

TEST(TTest, SwappingTheSamplesChangesTheSignOnly) {
  for (const auto run :
       {+[](std::span<const double> a, std::span<const double> b) { return pairedTTest(a, b); },
        +[](std::span<const double> a, std::span<const double> b) { return pooledTTest(a, b); },
        +[](std::span<const double> a, std::span<const double> b) { return welchTTest(a, b); }}) {
    const TTest one = run(kFirstDrug, kSecondDrug);
    const TTest other = run(kSecondDrug, kFirstDrug);
    EXPECT_EQ(one.t, -other.t);
    EXPECT_EQ(one.p_value, other.p_value);
    EXPECT_EQ(one.interval.low, -other.interval.high);
  }
}

// R 4.2.2: (pt(-t, nu, log.p=TRUE) + log(2)) / log(10); mpmath 1.2.1's quadrature of the density at 40 digits
// agrees in all of them.
TEST(TTest, LogarithmOfPStaysFiniteInTheFarTail) {
  const auto expectClose = [](double t, double nu, double expected) {
    EXPECT_NEAR(log10TwoSidedP(t, nu) / expected, 1.0, 1e-13) << t << ", " << nu;
  };
  expectClose(2, 5, -0.99165759109158423);
  expectClose(-2, 5, -0.99165759109158423);
  expectClose(1000, 10, -25.608919320923681);
  expectClose(38, 1e4, -294.53811131326256);
  expectClose(60, 1e4, -669.50411497278873);
  expectClose(60, 2e5, -776.65025846925166);
  expectClose(200, 1e6, -8519.0602336199425);
  expectClose(1e60, 10, -595.60889941585827);
  expectClose(1e100, 3.7, -369.36000078913945);
  expectClose(1e300, 1, -300.19611987703015);
  EXPECT_EQ(log10TwoSidedP(0.0, 3.0), 0.0);
}

TEST(TTest, PUnderflowsWhereItsLogarithmDoesNot) {
  const Moments one = {5001, 0.0, 1.0};
  const Moments other = {5001, 60.0 * std::sqrt(2.0 / 5001.0), 1.0};
  const TTest test = pooledTTest(one, other);
  EXPECT_EQ(test.p_value, 0.0);
  EXPECT_NEAR(test.log10_p, -669.50411497278873, 1e-9);
}

TEST(TTest, RefusesWhatHasNoAnswer) {
  const std::vector<double> one = {1.0};
  const std::vector<double> same = {2.0, 2.0, 2.0};
  const std::vector<double> three = {1.0, 2.0, 4.0};
  const std::vector<double> broken = {1.0, std::numeric_limits<double>::quiet_NaN(), 4.0};
  EXPECT_THROW(pooledTTest(one, three), base::InputError);
  EXPECT_THROW(pooledTTest(three, {}), base::InputError);
  EXPECT_THROW(welchTTest(same, same), base::InputError);
  EXPECT_THROW(pairedTTest(three, kFirstDrug), base::InputError);
  EXPECT_THROW(pairedTTest(three, three), base::InputError);
  EXPECT_THROW(pooledTTest(three, same, 1.0), base::InputError);
  EXPECT_THROW(pooledTTest(Moments{1, 0.0, 1.0}, Moments{3, 0.0, 1.0}), base::InputError);
  EXPECT_NO_THROW(welchTTest(three, same));
  try {
    welchTTest(three, broken);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "second sample[1]");
  }
}

// 0.1 + 0.2 − 0.2 and the like: differences that vary in their last bit only are constant.
TEST(TTest, RoundingIsNoSpread) {
  for (const std::vector<double>& first : {std::vector<double>{0.1, 0.3, 0.7, 1.1}, {-1e9, 1e9, -3e8, 3e8}}) {
    std::vector<double> second;
    for (const double x : first) second.push_back(x + 0.2);
    EXPECT_THROW(pairedTTest(first, second), base::InputError);
  }
}

}  // namespace
}  // namespace capstan::stats
