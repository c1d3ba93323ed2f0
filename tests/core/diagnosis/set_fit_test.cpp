// Fits of one set of effects from several starts.
#include "core/diagnosis/selection/set_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

/// A RAVEN-II with an effect in joint 2, and the fit of the nominal robot.
struct Fitted {
  explicit Fitted(test::Effect effect) : planted(5, effect, 2) {}

  /// Fit of `effect` in joint 2 from its start `start`.
  SetFit from(const char* effect, std::size_t start) const {
    const Hypothesis& hypothesis = *hypothesisNamed(effect);
    const auto starts = hypothesis.starts(scalesOf(base.scales(), 2), 2);
    const FitModel model = base.with(hypothesis, 2, starts.at(start));
    SetFit set = nominal;
    set.effects = {{&hypothesis, 2}};
    set.fit.u = model.startFrom(base, nominal.fit.u);
    set.fit.model = model;
    SetFitter::thin(set);
    fitter.relinearise(set);
    return set;
  }

  Planted planted;
  FitData data{planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2};
  FitModel base{planted.robot, jointScales(planted.evidence, planted.robot)};
  SetFitter fitter{data};
  SetFit nominal = fitter.nominal(base, Eigen::VectorXd::Zero(base.size()));
};

TEST(SetFit, StartsFromTheOtherFormsOfItsEffects) {
  const Fitted of(test::Effect::kStribeckFriction);
  const std::vector<SetFit> stribeck = of.fitter.fromOtherForms(of.from("stribeck_friction", 0));
  ASSERT_EQ(stribeck.size(), 2U) << "three speeds, of which it has one";
  for (const SetFit& one : stribeck) {
    EXPECT_EQ(one.effects, EffectSet({{hypothesisNamed("stribeck_friction"), 2}}));
    EXPECT_FALSE(one.settled);
  }
  const auto speedOf = [](const SetFit& set) { return set.fit.model.effects().back().start.value.at(1); };
  EXPECT_LT(speedOf(stribeck[0]), speedOf(stribeck[1]));
  EXPECT_TRUE(of.fitter.fromOtherForms(of.from("viscous_friction", 0)).empty()) << "it has one number";
  EXPECT_TRUE(of.fitter.fromOtherForms(of.from("encoder_slip", 0)).empty()) << "score tests try the times";
}

/// Score tests write what they predict into an effect's size: of a wave, its sine and cosine.
TEST(SetFit, IsOfOneFormWhateverScoreTestsHavePredicted) {
  const Fitted of(test::Effect::kPositionFriction);
  for (const auto& [effect, others] : {std::pair("position_friction", 3U), {"capstan_eccentricity", 0U}}) {
    const std::vector<ScoreTest> tests = screen(of.data, of.nominal.fit, of.nominal.weighting,
                                                candidatesOf(of.planted.evidence, of.base, {effect}));
    ASSERT_FALSE(tests.empty());
    EXPECT_NE(tests.front().start.value, tests.front().from) << "predicted";
    SetFit fit = of.fitter.extended(of.nominal, {tests.front()}).front();
    SetFitter::thin(fit);
    of.fitter.relinearise(fit);
    EXPECT_EQ(of.fitter.fromOtherForms(fit).size(), others) << effect;
  }
}

/// Whichever form the fit begins with, its speed can become that of any other.
TEST(SetFit, ShapesReachThoseOfAllForms) {
  const Fitted of(test::Effect::kStribeckFriction);
  const Hypothesis& stribeck = *hypothesisNamed("stribeck_friction");
  std::vector<double> speeds;
  for (const EffectStart& start : stribeck.starts(scalesOf(of.base.scales(), 2), 2))
    speeds.push_back(start.value[1]);
  ASSERT_EQ(speeds.size(), 3U);
  for (std::size_t start = 0; start < speeds.size(); ++start) {
    const FitModel model = of.from("stribeck_friction", start).fit.model;
    const EffectTerm& term = model.effects().back();
    ASSERT_FALSE(term.background);
    const FitParameter& speed = model.parameters()[static_cast<std::size_t>(term.index[1])];
    EXPECT_DOUBLE_EQ(speed.start, speeds[start]);
    EXPECT_LT(speed.low, 0.2 * std::ranges::min(speeds));
    EXPECT_GT(speed.high, 5.0 * std::ranges::max(speeds));
  }
}

TEST(SetFit, TestsEffectsAtTheNominalParametersToo) {
  const Fitted of(test::Effect::kBacklash);
  const std::vector<EffectCandidate> candidates = candidatesOf(of.planted.evidence, of.base, {});
  const std::vector<SetFit> sets = of.fitter.extendedFromNominal(of.nominal, candidates, 3);
  ASSERT_EQ(sets.size(), 3U);
  const EffectSet backlash({{hypothesisNamed("backlash"), 2}});
  EXPECT_TRUE(std::ranges::any_of(sets, [&](const SetFit& set) { return set.effects == backlash; }));
  for (const SetFit& set : sets) EXPECT_FALSE(set.settled);
}

}  // namespace
}  // namespace capstan::diagnosis
