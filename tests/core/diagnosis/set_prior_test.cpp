// The prior of sets of effects.
#include "core/diagnosis/selection/set_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/screening.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

TEST(SetPrior, SharesAProbabilityByTheInstantsOfAnEvent) {
  const Planted planted(5, test::Effect::kStribeckFriction, 2);
  const SetPrior prior(planted.evidence, 40);
  const auto of = [&](const char* effect) { return prior.of(EffectSet({{hypothesisNamed(effect), 2}})); };
  const double at_any_time = of("backlash");
  const double instants = planted.evidence.front().duration() / kEventStep;
  EXPECT_NEAR(of("encoder_slip"), at_any_time - std::log(instants), 1e-12);
  EXPECT_DOUBLE_EQ(prior.of(EffectSet()) - at_any_time, prior.costOfOneMore(0));
  EXPECT_NEAR(prior.costOfOneMore(0), std::log(40.0 / kEffectOdds), 1e-12);
}

}  // namespace
}  // namespace capstan::diagnosis
