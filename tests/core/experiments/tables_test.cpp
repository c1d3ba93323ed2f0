// Tables from results whose numbers are the paper's own: table II must follow from table I as printed there.
#include "core/experiments/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
  results.specification = findSpecification("C").text;
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
  for (std::size_t row = 0; row < 18; ++row) {  // each row of a CSV is whole
    EXPECT_EQ(table.rows[row][0].text, results.trials[row / 3].name);
    EXPECT_EQ(table.rows[row][1].number, results.trials[row / 3].duration());
  }
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

TEST(Tables, TrialsWithoutEncodersAreNotCounted) {
  const Published published = readPublished();
  Results results = paperTrials(published, 0.0899);
  EXPECT_THAT(meanTable(results, &published).note, HasSubstr("Means over 6 trials; P"));
  results.trials[1].counts.fill(0);
  EXPECT_THAT(meanTable(results, &published).note,
              HasSubstr("Means over 5 trials, 1 without joint encoders excluded; P"));
  results.trials.resize(1);
  EXPECT_THAT(meanTable(results, nullptr).note, HasSubstr("Means over 1 trial. "));
}

TEST(Tables, NothingImprovesOnTheRobotsOwnKinematics) {
  Results results = paperTrials(readPublished(), 0.0899);
  for (TrialResult& trial : results.trials) trial.own_kinematics = true;
  const base::Table means = meanTable(results, nullptr);
  for (const base::TableColumn& column : means.columns)
    EXPECT_THAT(column.name, ::testing::Not(::testing::AnyOf(HasSubstr("improvement"), HasSubstr("P,"))));
  for (const auto& row : means.rows) EXPECT_EQ(row.size(), means.columns.size());
  for (const base::Table& table : {means, trialTable(results, nullptr)}) {
    EXPECT_THAT(table.title, HasSubstr("differences from the robot's own kinematics"));
    EXPECT_THAT(table.note, HasSubstr("cannot show which estimate is right"));
  }
}

TEST(Tables, IdentifiedKinematicsAreAColumnOnlyWhereTheRobotIsAnother) {
  Results results = paperTrials(readPublished(), 0.0899);
  const auto has = [&](const base::Table& table, const std::string& name) {
    return std::any_of(table.columns.begin(), table.columns.end(),
                       [&](const base::TableColumn& column) { return column.name == name; });
  };
  EXPECT_TRUE(has(trialTable(results, nullptr), "kinematic, identified robot"));  // zero in the fixture
  EXPECT_TRUE(has(meanTable(results, nullptr), "improvement on identified kinematics"));
  for (TrialResult& trial : results.trials)
    trial.rms[static_cast<std::size_t>(Estimator::kIdentified)] = trial.rmsOf(Estimator::kKinematic);
  for (const base::Table& table : {trialTable(results, nullptr), meanTable(results, nullptr)}) {
    EXPECT_FALSE(has(table, "kinematic, identified robot"));
    EXPECT_FALSE(has(table, "improvement on identified kinematics"));
    EXPECT_THAT(table.note, ::testing::Not(HasSubstr("Identified kinematics")));
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
}

Results identified(const std::string& name, const std::string& parameter, double truth, double value,
                   bool seen) {
  Results results;
  results.name = name;
  results.specification = findSpecification(name).text;
  results.work = Work::kIdentify;
  IdentifiedParameter& one = results.identification.emplace().parameters.emplace_back();
  one.name = parameter;
  one.truth = truth;
  one.batch = {value, 0.01 * value, 0.98 * value, 1.02 * value, seen, seen ? "" : "moves too little"};
  return results;
}

TEST(Comparison, GoalsAreComputed) {
  const Published published = readPublished();
  const auto met = [&](const Results& results) {
    return goalsOf({results}, published).at(0).verdict == Verdict::kMet;
  };
  EXPECT_TRUE(met(identified("A", "r_l1", 0.059, 0.05910, true)));
  EXPECT_FALSE(met(identified("A", "r_l1", 0.059, 0.05925, true)));
  EXPECT_TRUE(met(identified("B", "k_e2", 100.0, 104.9, true)));
  EXPECT_FALSE(met(identified("B", "k_e2", 100.0, 105.1, true)));
  EXPECT_TRUE(met(identified("B", "b_e2", 100.0, 114.9, true)));
  EXPECT_FALSE(met(identified("B", "b_e2", 100.0, 115.1, true)));
  EXPECT_TRUE(met(identified("B", "b_e1", 100.0, 300.0, false)));
  Results known = identified("B", "r_l1", 0.059, 0.05910, false);
  known.identification->inputs.robot = "identified before";
  EXPECT_TRUE(goalsOf({known}, published).empty()) << "its pulley was A's affair";

  const std::vector<Goal> c = goalsOf({paperTrials(published, 0.0899)}, published);
  ASSERT_EQ(c.size(), 6U);  // the paper's errors are the paper's
  for (int i = 0; i < 3; ++i) EXPECT_EQ(c[static_cast<std::size_t>(i)].verdict, Verdict::kMet);
}

TEST(Comparison, OcclusionIsLeastAgainstMost) {
  Results d;
  d.name = "D";
  d.specification = findSpecification("D").text;
  for (const double share : {80.0, 10.0}) {
    TrialResult& trial = d.trials.emplace_back();
    trial.occlusion.percentage = share;
    trial.rms[static_cast<std::size_t>(Estimator::kUkf)] =
        share > 50.0 ? Eigen::Vector3d(1.05, 1.2, 1.0) : Eigen::Vector3d(1.0, 1.0, 1.0);
  }
  const std::vector<Goal> goals = goalsOf({d}, readPublished());
  ASSERT_EQ(goals.size(), 3U);
  EXPECT_EQ(goals[0].verdict, Verdict::kMet);
  EXPECT_EQ(goals[1].verdict, Verdict::kMissed);
  EXPECT_EQ(goals[1].measured, "1.200 times");
}

TEST(Comparison, WhatMissesItsGoalMayHaveSaidSo) {
  const Published published = readPublished();
  Results results = identified("B", "k_e1", 100.0, 109.0, true);
  ParameterEstimate& estimate = results.identification->parameters[0].batch;
  const auto goal = [&] { return goalsOf({results}, published).at(0); };
  EXPECT_EQ(goal().verdict, Verdict::kMissed);  // σ 1 %, and nothing said
  estimate.advice = "joint 1 moves too little";
  EXPECT_EQ(goal().verdict, Verdict::kMissed);  // σ 1 %: words alone are no doubt
  estimate.sigma = 0.06 * estimate.value;
  estimate.low = 97.0;
  EXPECT_EQ(goal().verdict, Verdict::kSaid);
  EXPECT_THAT(goal().measured, HasSubstr("± 6.00 %; said of it: joint 1 moves too little"));
  EXPECT_THAT(base::markdownOf(goalTable({goal()})), HasSubstr("| not met, reported |"));
  estimate.low = 100.5;  // the truth is outside what it says
  EXPECT_EQ(goal().verdict, Verdict::kMissed);
  estimate.low = 97.0;
  estimate.advice.clear();
  EXPECT_EQ(goal().verdict, Verdict::kMissed);  // nothing is said
  results.identification->parameters[0].convergence = "about 90 s more of this motion";
  EXPECT_EQ(goal().verdict, Verdict::kSaid);
}

TEST(Comparison, TheParameterTableSaysWhereTheMethodsBegan) {
  Results b = identified("B", "k_e1", 100.0, 103.0, true);
  EXPECT_EQ(parameterTable(b, nullptr).columns[1].name, "nominal");
  for (const base::TableColumn& column : parameterTable(b, nullptr).columns)
    EXPECT_THAT(column.name, ::testing::Not(HasSubstr("paper")));
  b.identification->inputs.nominal = "name: drawing\n";
  b.identification->inputs.robot = "name: found\n";
  const base::Table table = parameterTable(b, nullptr);
  EXPECT_EQ(table.columns[1].name, "start");
  EXPECT_THAT(table.note, HasSubstr("Start: where both methods began, the robot of A."));
  const Published published = readPublished();
  const base::Table a = parameterTable(identified("A", "r_l1", 0.059, 0.059, true), &published);
  EXPECT_EQ(a.columns.size(), table.columns.size() + 2);
  EXPECT_EQ(a.rows[0].size(), a.columns.size());
}

TEST(Comparison, WithoutATruthThereIsNoColumnOfIt) {
  Results b = identified("B", "k_e1", kNone, 103.0, true);
  const base::Table table = parameterTable(b, nullptr);
  for (const base::TableColumn& column : table.columns)
    EXPECT_THAT(column.name, ::testing::Not(::testing::AnyOf(HasSubstr("truth"), HasSubstr("error"))));
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
  EXPECT_THAT(table.rows[0][3].text, HasSubstr("103 ± "));
}

TEST(Comparison, AMethodThatFoundNothingIsSaid) {
  Results b = identified("B", "k_e1", 100.0, 103.0, true);
  EXPECT_THAT(parameterTable(b, nullptr).note, ::testing::Not(HasSubstr("Batch")));
  b.identification->batch_end = "failed";
  EXPECT_THAT(parameterTable(b, nullptr).note, HasSubstr("Batch: failed."));
}

TEST(Comparison, ThePaperIsSpokenOfWhereTheExperimentIsThePapers) {
  const Published published = readPublished();
  Results results = paperTrials(published, 0.0899);
  EXPECT_THAT(comparisonPage({results}, published), HasSubstr("kinematic, paper"));
  EXPECT_THAT(comparisonPage({results}, published), ::testing::Not(HasSubstr("figures 7 and 13")));
  const std::string paper = results.specification;
  results.specification = std::string(paper).replace(paper.find("seed: 301"), 9, "seed: 999");
  EXPECT_TRUE(isPapers(results));
  const auto duration = paper.find("duration: 188");
  for (const std::string& other :
       {std::string(paper).replace(duration, 13, "duration: 187"), std::string()}) {
    results.specification = other;  // of the same name, with six trials
    EXPECT_FALSE(isPapers(results));
    const std::string page = comparisonPage({results}, published);
    EXPECT_THAT(page, ::testing::Not(HasSubstr("paper")));
    EXPECT_THAT(page, HasSubstr("RMS errors by trial"));
    EXPECT_TRUE(goalsOf({results}, published).empty());
  }
  results.name = "mine";
  results.specification = paper;
  EXPECT_FALSE(isPapers(results));
}

TEST(Comparison, ThePageSaysWhatItsNumbersWereMadeFrom) {
  const Published published = readPublished();
  Results mine;
  mine.name = "mine";
  mine.software = "capstan 9.9.9";
  mine.wall_seconds = kNone;
  TrialResult& simulated = mine.trials.emplace_back();
  simulated.name = "free";
  simulated.seed = 42;
  TrialResult& recorded = mine.trials.emplace_back();
  recorded.name = "real";
  recorded.simulated = false;
  recorded.inputs.recording = "monday.capstan, 17 bytes";
  EXPECT_THAT(comparisonPage({mine}, published),
              HasSubstr("\n- mine; free (seed 42), real (monday.capstan, 17 bytes); capstan 9.9.9\n"));
  Results b = identified("B", "k_e1", 100.0, 103.0, true);
  b.title = "Cables";
  EXPECT_THAT(comparisonPage({b}, published), HasSubstr("\n- B: Cables; block transfer (seed 201)"));
  EXPECT_THAT(comparisonPage({b}, published),
              ::testing::Not(HasSubstr("Units are")));  // of joints: none here
  EXPECT_THAT(comparisonPage({b, mine}, published), HasSubstr("Units are deg, deg, mm.\n\n### Where"));
}

TEST(Comparison, ThePageSaysThatTheRobotIsSimulated) {
  Results results = paperTrials(readPublished(), 0.0899);
  EXPECT_THAT(comparisonPage({results}, readPublished()), HasSubstr("is simulated"));
  EXPECT_THAT(comparisonPage({results}, readPublished()), ::testing::Not(HasSubstr("hysteresis")));
  results.trials.front().inputs.truth = "name: laboratory\n";
  EXPECT_THAT(comparisonPage({results}, readPublished()), HasSubstr("it has hysteresis"));
  results.simulated = false;
  EXPECT_THAT(comparisonPage({results}, readPublished()), ::testing::Not(HasSubstr("robot is simulated")));
}

}  // namespace
}  // namespace capstan::experiments
