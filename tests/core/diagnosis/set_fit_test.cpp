// Fits of one set of effects from several starts.
#include "core/diagnosis/selection/set_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/screening.h"
#include "core/diagnosis/selection/set_prior.h"
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

TEST(SetPrior, SharesAProbabilityByTheFormsOfALaw) {
  const Planted planted(5, test::Effect::kStribeckFriction, 2);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  const SetPrior prior(planted.evidence, base.scales(), 40);
  const auto of = [&](const char* effect) { return prior.of(EffectSet({{hypothesisNamed(effect), 2}})); };
  const double one_form = of("viscous_friction");
  EXPECT_NEAR(of("backlash"), one_form - std::log(3.0), 1e-12) << "three ways of its damper";
  EXPECT_DOUBLE_EQ(of("capstan_eccentricity"), one_form) << "sine and cosine are sizes";
  EXPECT_NEAR(of("stribeck_friction"), one_form - std::log(3.0), 1e-12) << "three speeds";
  EXPECT_NEAR(of("position_friction"), one_form - std::log(4.0), 1e-12) << "four periods";
  const double instants = planted.evidence.front().duration() / kEventStep;
  EXPECT_NEAR(of("encoder_slip"), one_form - std::log(instants), 1e-12);
  EXPECT_DOUBLE_EQ(prior.of(EffectSet()) - one_form, prior.costOfOneMore(0));
}

}  // namespace
}  // namespace capstan::diagnosis
