// Tables from results whose numbers are the paper's own: table II must follow from table I as printed there.
#include "core/experiments/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/experiments/comparison.h"

namespace capstan::experiments {
namespace {

using ::testing::HasSubstr;

double toSi(double shown, int joint) { return joint == 2 ? shown * 1e-3 : shown * std::numbers::pi / 180.0; }

/// Six trials with the paper's table I. `third` stands in for joint 3's second UKF value, [cm].
Results paperTrials(const Published& published, double third) {
  Results results;
  results.name = "C";
  for (std::size_t i = 0; i < 6; ++i) {
    TrialResult& trial = results.trials.emplace_back();
    trial.name = "trial " + std::to_string(i + 1);
    trial.end = published.table_1.duration[i];
    trial.counts.fill(1);
    for (auto& rms : trial.rms) rms.setZero();
    for (int joint = 0; joint < 3; ++joint) {
      const PublishedJoint& of = published.table_1.joint(joint);
      const double ukf = joint == 2 && i == 1 ? third : of.ukf[i];
      trial.rms[static_cast<std::size_t>(Estimator::kUkf)](joint) = toSi(publishedScale(joint) * ukf, joint);
      trial.rms[static_cast<std::size_t>(Estimator::kKinematic)](joint) =
          toSi(publishedScale(joint) * of.kinematic[i], joint);
    }
  }
  return results;
}

TEST(Tables, TableTwoFollowsFromTableOneAsInThePaper) {
  const Published published = readPublished();
  const Results results = paperTrials(published, 0.0899);
  for (int joint = 0; joint < 3; ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    const Improvement ours = improvementOf(results, Estimator::kKinematic, Estimator::kUkf, joint);
    const double paper_p = published.table_2.p_value[j];
    EXPECT_NEAR(ours.p_pooled / paper_p, 1.0, 0.025) << joint;
    EXPECT_GT(ours.p_welch, ours.p_pooled);
    // Plain means here; the paper weights by duration, which moves them by less than 5 %.
    EXPECT_NEAR(ours.mean_before / (publishedScale(joint) * published.table_2.kinematic[j]), 1.0, 0.05);
    EXPECT_NEAR(ours.percent, published.table_2.improvement[j], 3.5);
    EXPECT_NEAR(ours.percent, 100.0 * (1.0 - ours.mean / ours.mean_before), 1e-12);
  }
}

TEST(Tables, JointThreeNeedsTheDigitsInTheOtherOrder) {
  const Published published = readPublished();
  const Results printed = paperTrials(published, published.table_1.joint_3.ukf[1]);
  const double p = improvementOf(printed, Estimator::kKinematic, Estimator::kUkf, 2).p_pooled;
  EXPECT_GT(p / published.table_2.p_value[2], 1.4);
}

TEST(Tables, PaperStandsBesideOurs) {
  const Published published = readPublished();
  const Results results = paperTrials(published, 0.0899);
  const base::Table table = trialTable(results, &published);
  ASSERT_EQ(table.rows.size(), 18U);
  ASSERT_EQ(table.columns[3].name, "kinematic, paper");
  for (std::size_t row = 0; row < 18; ++row) {
    EXPECT_NEAR(table.rows[row][3].number, table.rows[row][4].number, 1e-12);
    if (row != 5) {
      EXPECT_NEAR(table.rows[row][5].number, table.rows[row][6].number, 1e-12);
    }
  }
  EXPECT_NEAR(table.rows[5][5].number, 0.989, 1e-12);  // as printed, in mm
  EXPECT_EQ(trialTable(results, nullptr).columns.size(), table.columns.size() - 2);
  EXPECT_THAT(base::markdownOf(meanTable(results, &published)), HasSubstr("2.6e-09"));
}

TEST(Tables, OneTrialHasNoPValue) {
  const Improvement one = improvementOf({2.0}, {1.0});
  EXPECT_DOUBLE_EQ(one.percent, 50.0);
  EXPECT_TRUE(std::isnan(one.p_pooled));
  EXPECT_TRUE(std::isnan(improvementOf({}, {}).mean));
}

TEST(Tables, ABoxplotRowIsOfAbsoluteErrors) {
  Results results;
  results.name = "D";
  TrialResult& trial = results.trials.emplace_back();
  trial.name = "10 %";
  for (int i = 0; i < 9; ++i) {
    ErrorPoint& point = trial.errors.emplace_back();
    point.kinematic.setConstant(toSi(2.0, 0));
    point.ukf = Eigen::Vector3d::Constant(toSi(i % 2 == 0 ? i : -i, 0));
    point.identified.setZero();
  }
  const base::Table table = boxplotTable(results);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_NEAR(table.rows[0][2].number, 2.0, 1e-12);  // median, kinematic
  EXPECT_NEAR(table.rows[0][3].number, 4.0, 1e-12);  // median of 0…8
  EXPECT_NEAR(table.rows[0][4].number, 2.0, 1e-12);
  EXPECT_NEAR(table.rows[0][5].number, 6.0, 1e-12);
  EXPECT_NEAR(table.rows[0][6].number, 8.0, 1e-12);
}

Results identified(const std::string& name, const std::string& parameter, double truth, double value,
                   bool seen) {
  Results results;
  results.name = name;
  results.work = Work::kIdentify;
  IdentifiedParameter& one = results.identification.emplace().parameters.emplace_back();
  one.name = parameter;
  one.truth = truth;
  one.batch = {value, 0.01 * value, 0.98 * value, 1.02 * value, seen, seen ? "" : "moves too little"};
  return results;
}

TEST(Comparison, GoalsAreComputed) {
  const Published published = readPublished();
  const auto met = [&](const Results& results) { return goalsOf({results}, published).at(0).met; };
  EXPECT_TRUE(met(identified("A", "r_l1", 0.059, 0.05910, true)));
  EXPECT_FALSE(met(identified("A", "r_l1", 0.059, 0.05925, true)));
  EXPECT_TRUE(met(identified("B", "k_e2", 100.0, 104.9, true)));
  EXPECT_FALSE(met(identified("B", "k_e2", 100.0, 105.1, true)));
  EXPECT_TRUE(met(identified("B", "b_e2", 100.0, 114.9, true)));
  EXPECT_FALSE(met(identified("B", "b_e2", 100.0, 115.1, true)));
  EXPECT_TRUE(met(identified("B", "b_e1", 100.0, 300.0, false)));

  const std::vector<Goal> c = goalsOf({paperTrials(published, 0.0899)}, published);
  ASSERT_EQ(c.size(), 6U);  // the paper's errors are the paper's
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(c[static_cast<std::size_t>(i)].met);
}

TEST(Comparison, OcclusionIsLeastAgainstMost) {
  Results d;
  d.name = "D";
  for (const double share : {80.0, 10.0}) {
    TrialResult& trial = d.trials.emplace_back();
    trial.occlusion.percentage = share;
    trial.rms[static_cast<std::size_t>(Estimator::kUkf)] =
        share > 50.0 ? Eigen::Vector3d(1.05, 1.2, 1.0) : Eigen::Vector3d(1.0, 1.0, 1.0);
  }
  const std::vector<Goal> goals = goalsOf({d}, readPublished());
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_TRUE(goals[0].met);
  EXPECT_FALSE(goals[1].met);
  EXPECT_EQ(goals[1].measured, "1.200 times");
}

TEST(Comparison, ThePageSaysThatTheRobotIsSimulated) {
  Results results = paperTrials(readPublished(), 0.0899);
  EXPECT_THAT(comparisonPage({results}, readPublished()), HasSubstr("is simulated"));
  results.simulated = false;
  EXPECT_THAT(comparisonPage({results}, readPublished()), ::testing::Not(HasSubstr("robot is simulated")));
}

}  // namespace
}  // namespace capstan::experiments
