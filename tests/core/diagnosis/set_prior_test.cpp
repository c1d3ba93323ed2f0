// The prior of sets of effects.
#include "core/diagnosis/selection/set_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/screening.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

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
  EXPECT_NEAR(of("sensor_sign"), one_form - std::log(2.0), 1e-12) << "loads that start positive or negative";
  const double instants = planted.evidence.front().duration() / kEventStep;
  EXPECT_NEAR(of("encoder_slip"), one_form - std::log(instants), 1e-12);
  EXPECT_DOUBLE_EQ(prior.of(EffectSet()) - one_form, prior.costOfOneMore(0));
  for (const EffectCandidate& effect : candidatesOf(planted.evidence, base, {}))
    EXPECT_LE(prior.of(EffectSet({effect})), one_form) << effect.name() << effect.joint;
}

}  // namespace
}  // namespace capstan::diagnosis
