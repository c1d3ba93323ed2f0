// The words and sizes of a verdict: of effects that may be there, too.
#include "core/diagnosis/selection/verdict.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

constexpr double kHalfWidth = 3e-4;  // m

/// A selection of the refitted nominal robot; the most probable set has a backlash of joint 2.
Selection undecided(const FitData& data, const Planted& planted) {
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  const SetFit without = SetFitter(data).nominal(nominal, Eigen::VectorXd::Zero(nominal.size()));
  const Hypothesis& backlash = *hypothesisNamed("backlash");
  const FitModel model = nominal.with(backlash, 2, {{kHalfWidth, 1.0}, {kHalfWidth, 0.0}});
  SetFit with{
      {{&backlash, 2}},
      linearise(data, model, model.startFrom(nominal, without.fit.u), noneBeyond(data), without.weighting),
      without.weighting,
      without.fitted,
      without.squares,
      true};
  SetFitter::thin(with);
  return {.base = without.fit,
          .base_squares = without.squares,
          .input_noise = noInputNoise(static_cast<Eigen::Index>(data.channels().size())),
          .torque_noise = noInputNoise(static_cast<Eigen::Index>(data.channels().size())),
          .best = without.fit,
          .best_squares = without.squares,
          .weighting = without.weighting,
          .effects = {},
          .uncertain = {{{&backlash, 2}, 0.58}},
          .competitors = {},
          .posterior = {},
          .probable = {{with, 0.58}, {without, 0.42}},
          .candidates = {}};
}

TEST(Verdict, GivesTheSizeOfAnEffectThatMayBeThere) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  Report report;
  judge(data, undecided(data, planted), planted.robot, report);
  EXPECT_TRUE(report.causes.empty()) << "it is no cause";
  ASSERT_EQ(report.uncertain.size(), 1U);
  const Cause& one = report.uncertain.front();
  EXPECT_EQ(one.effect, "backlash");
  EXPECT_EQ(one.joint, 2);
  EXPECT_EQ(one.probability, 0.58);
  const FoundParameter& half_width = one.parameters.front();
  EXPECT_NEAR(half_width.value, kHalfWidth, 1e-9);
  EXPECT_GT(half_width.sigma, 0.0);
  const double radius = planted.robot.drives[1].link_radius;
  EXPECT_NEAR(half_width.joint_per_length * radius, 1.0, 1e-12);
  ASSERT_EQ(one.moves.joints.size(), 3U);
  EXPECT_GT(one.moves.joints[1].largest, 0.5 * kHalfWidth / radius);
  const std::string words =
      "Backlash (joint 2) may be there, too (probability 58 %): " + shownParameter("backlash", half_width);
  EXPECT_NE(report.summary.find(words), std::string::npos) << report.summary;
  EXPECT_NE(report.summary.find("; moves joint 2 by "), std::string::npos) << report.summary;
}

/// Two sets with the effect: each σ has their spread as well.
TEST(Verdict, OfASizeIsAsSureAsTheProbableSetsAgree) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  Selection selection = undecided(data, planted);
  const auto sigmaOf = [&] {
    Report report;
    judge(data, selection, planted.robot, report);
    return report.uncertain.front().parameters.front().sigma;
  };
  const double of_one = sigmaOf();
  ProbableSet other = selection.probable.front();
  const FitModel& model = other.set.fit.model;
  const int index = model.effects().back().index.front();
  ASSERT_GE(index, 0);
  constexpr double kFurther = 0.5;  // of the parameter's scale
  other.set.fit.u[index] += kFurther;
  other.probability = 0.29;
  selection.probable = {selection.probable[0], other};
  const double further = kFurther * model.parameters()[static_cast<std::size_t>(index)].scale;
  EXPECT_NEAR(sigmaOf(), std::hypot(of_one, std::sqrt(0.29 / (0.58 + 0.29)) * further), 1e-9 * of_one);
}

/// Torques between the rows may have caused all that is left, and not all that was there before.
TEST(Verdict, TorquesExplainNoMoreThanEffectsLeave) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  Selection selection = undecided(data, planted);
  selection.best_squares.sum *= 0.0;
  selection.base_squares.sum *= 0.0;
  const double noise = data.channels()[1].noise;
  selection.base_squares.sum.row(1) = 25.0 * noise * noise * selection.base_squares.count.row(1);
  selection.best_squares.sum.row(1) = 10.0 * noise * noise * selection.best_squares.count.row(1);
  EXPECT_NEAR(explainedShare(data, selection), 15.0 / 24.0, 1e-9);
  selection.torque_noise.rms[1] = 2.0 * noise;
  EXPECT_NEAR(explainedShare(data, selection), 15.0 / 20.0, 1e-9);
  selection.torque_noise.rms[1] = 20.0 * noise;  // an upper bound
  EXPECT_NEAR(explainedShare(data, selection), 1.0, 1e-9);
}

Report reportOf(std::vector<Cause> causes) {
  Report report;
  report.explained = 1.0;
  report.causes = std::move(causes);
  return report;
}

TEST(Verdict, IsATieOnlyIfTheFirstCauseHasCompetingExplanations) {
  const Cause inertia{.effect = "inertia", .joint = 1, .parameters = {}},
      compliance{.effect = "cable_compliance", .joint = 3, .parameters = {}};
  Report report = reportOf({inertia, compliance});
  EXPECT_EQ(verdictOf(report, false), Verdict::kSeveral);
  report.ties = {tieOf(compliance, {{"inertia", 3}}, {0.7, 0.3})};
  EXPECT_EQ(verdictOf(report, false), Verdict::kSeveral);
  report.ties = {tieOf(inertia, {{"payload", 0}}, {0.6, 0.4}), report.ties.front()};
  EXPECT_EQ(verdictOf(report, false), Verdict::kTie);
}

TEST(Verdict, NamesTheTiesOfLaterCausesToo) {
  const Cause inertia{.effect = "inertia", .joint = 1, .parameters = {}},
      compliance{.effect = "cable_compliance", .joint = 3, .parameters = {}};
  Report report = reportOf({inertia, compliance});
  const Tie of_first = tieOf(inertia, {{"payload", 0}}, {0.6, 0.4}),
            of_second = tieOf(compliance, {{"inertia", 3}}, {0.7, 0.3});
  const std::string second = fmt::format(" {} (joint 3) and {} (joint 3) cannot be distinguished.",
                                         titleOf("cable_compliance"), titleOf("inertia"));
  report.verdict = Verdict::kSeveral;
  report.ties = {of_second};
  EXPECT_TRUE(summaryOf(report).ends_with("of what is beyond noise)." + second)) << summaryOf(report);
  report.verdict = Verdict::kTie;
  report.ties = {of_first, of_second};
  EXPECT_EQ(summaryOf(report), fmt::format("This recording cannot distinguish {} (joint 1) and {}.{}",
                                           titleOf("inertia"), titleOf("payload"), second));
}

}  // namespace
}  // namespace capstan::diagnosis
