// The cable-driven Raven UKF paper, Table I: root mean square errors of six trials, and Table II: P values of
// "Student's t-test" between the filter and transmission kinematics. Which t-test it was is not said there.
//
// Finding: the two-sample test with pooled variance, two-sided, reproduces the P values of joints 1 and 2 to
// all digits printed (0.0025, 0.0015). Paired (0.022, 0.0044) and Welch's (0.0072, 0.0040) do not, nor does a
// one-sided P (half). The trials are pairs, so the paired test is the one that suits them.
//
// Joint 3 as printed gives 3.86e-9 by the same test, not 2.59e-9. Trial 2 of its filter column is printed
// 0.0989; with the digits in the order 0.0899 the P value agrees within the rounding of Table I, and so does
// Table II's mean, 0.0790 (as printed: 0.0798). Table II's means are weighted by the trials' durations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "core/stats/t_test.h"

namespace capstan::stats {
namespace {

using Trials = std::array<double, 6>;

struct Joint {
  Trials filter;
  Trials kinematics;
};

constexpr Joint kJoint1 = {{0.7525, 0.5958, 0.8414, 0.7881, 0.8167, 0.6825},   // deg
                           {1.4294, 1.6644, 1.0847, 0.9313, 0.9827, 1.4675}};  // deg
constexpr Joint kJoint2 = {{1.6373, 1.8665, 1.7965, 1.7541, 1.7644, 1.4220},   // deg
                           {2.8012, 2.5525, 2.9971, 1.9428, 2.3691, 2.1314}};  // deg
constexpr Joint kJoint3 = {{0.0869, 0.0989, 0.0606, 0.0852, 0.0852, 0.0763},   // cm
                           {0.2792, 0.3036, 0.3227, 0.2647, 0.2730, 0.2675}};  // cm
constexpr Trials kSeconds = {188, 80, 150, 82, 110, 290};

Joint correctedJoint3() {
  Joint joint = kJoint3;
  joint.filter[1] = 0.0899;
  return joint;
}

double weightedMean(const Trials& trials) {
  return std::inner_product(trials.begin(), trials.end(), kSeconds.begin(), 0.0) /
         std::accumulate(kSeconds.begin(), kSeconds.end(), 0.0);
}

TEST(PublishedTrials, PooledTwoSidedReproducesJoints1And2) {
  EXPECT_NEAR(pooledTTest(kJoint1.kinematics, kJoint1.filter).p_value, 0.0025, 0.00005);
  EXPECT_NEAR(pooledTTest(kJoint2.kinematics, kJoint2.filter).p_value, 0.0015, 0.00005);
}

// scipy 1.10.1: scipy.stats.ttest_rel(kin, ukf).pvalue, ttest_ind(kin, ukf).pvalue,
// ttest_ind(kin, ukf, equal_var=False).pvalue
TEST(PublishedTrials, TheThreeTestsAgreeWithScipy) {
  struct ByScipy {
    const Joint& joint;
    double paired, pooled, welch;
  };
  for (const ByScipy& row :
       {ByScipy{kJoint1, 0.022127367701007206, 0.0024925005367715273, 0.00722897413499243},
        ByScipy{kJoint2, 0.004424488183248549, 0.0014925151105808928, 0.004049899299620735},
        ByScipy{kJoint3, 1.4883420985231358e-05, 3.8608267783423395e-09, 8.612831228455219e-08}}) {
    const auto& [filter, kinematics] = row.joint;
    EXPECT_NEAR(pairedTTest(kinematics, filter).p_value / row.paired, 1.0, 1e-11);
    EXPECT_NEAR(pooledTTest(kinematics, filter).p_value / row.pooled, 1.0, 1e-11);
    EXPECT_NEAR(welchTTest(kinematics, filter).p_value / row.welch, 1.0, 1e-11);
  }
}

TEST(PublishedTrials, Joint3AsPrintedDoesNotGiveThePrintedP) {
  EXPECT_GT(pooledTTest(kJoint3.kinematics, kJoint3.filter).p_value, 3.8e-9);
  EXPECT_NEAR(weightedMean(kJoint3.filter), 0.0798, 0.00005);
}

// Table I is rounded to 4 decimals: the printed P must lie between those of the ends of the rounding, each
// trial moved by half a digit towards its group's mean or away from it.
TEST(PublishedTrials, Joint3WithTwoDigitsSwappedGivesThePrintedPAndMean) {
  const auto spread = [](Trials trials, double by) {
    const double centre = std::accumulate(trials.begin(), trials.end(), 0.0) / 6.0;
    for (double& x : trials) x += x < centre ? -by : by;
    return trials;
  };
  const Joint joint = correctedJoint3();
  const double half_digit = 0.00005;
  EXPECT_LT(pooledTTest(spread(joint.kinematics, -half_digit), spread(joint.filter, -half_digit)).p_value,
            2.59e-9);
  EXPECT_GT(pooledTTest(spread(joint.kinematics, half_digit), spread(joint.filter, half_digit)).p_value,
            2.59e-9);
  EXPECT_NEAR(pooledTTest(joint.kinematics, joint.filter).p_value, 2.5615905786566444e-09, 1e-19);  // scipy
  EXPECT_NEAR(weightedMean(joint.filter), 0.0790, 0.00005);
}

TEST(PublishedTrials, TableTwosMeansAreWeightedByDuration) {
  EXPECT_NEAR(weightedMean(kJoint1.filter), 0.7419, 0.00005);
  EXPECT_NEAR(weightedMean(kJoint1.kinematics), 1.3051, 0.00005);
  EXPECT_NEAR(weightedMean(kJoint2.filter), 1.6411, 0.0001);  // 1.64101 of the rounded trials
  EXPECT_NEAR(weightedMean(kJoint3.kinematics), 0.2828, 0.00005);
}

}  // namespace
}  // namespace capstan::stats
