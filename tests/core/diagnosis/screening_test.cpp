// What score tests predict of a fit with one more effect.
#include "core/diagnosis/selection/screening.h"

#include <gtest/gtest.h>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/set_fit.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

/// A fit makes up for an effect with parameters that are far from nominal. With the effect they return: the
/// fall of the objective is that of the misfit and that of the priors.
TEST(Screening, CountsWhatTheFitsParametersRegain) {
  const Planted planted(5, test::Effect::kLoadFriction, 2);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  const SetFit nominal = SetFitter(data).nominal(base, Eigen::VectorXd::Zero(base.size()));
  const std::vector<ScoreTest> tests =
      screen(data, nominal.fit, nominal.weighting, candidatesOf(planted.evidence, base, {"load_friction"}));
  const double misfit = nominal.weighting.weights.cwiseProduct(nominal.fit.e).squaredNorm();
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().joint, 2);
  EXPECT_GT(tests.front().prior, 0.5);
  EXPECT_NEAR(tests.front().share * misfit + 2.0 * tests.front().prior, tests.front().gain,
              0.02 * tests.front().gain);
}

}  // namespace
}  // namespace capstan::diagnosis
