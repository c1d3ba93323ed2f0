// Residuals of blocks that were not fitted, folds, and what a recording counts in a fit.
#include "core/diagnosis/fit/held_out.h"

#include <gtest/gtest.h>

#include <set>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/set_fit.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

/// Mean square of a channel's held-out residual over that of the fit.
double heldOutRatio(const FitData& data, const SetFit& set, int channel) {
  return set.squares.meanSquare(channel) / squaresOf(data, set.fit.e).meanSquare(channel);
}

TEST(HeldOut, OfAPlayIsNearTheFitThatReachesTheNoise) {
  const Planted planted(3, test::Effect::kBacklash, 2);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const SetFitter fitter(data);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  SetFit nominal = fitter.nominal(base, Eigen::VectorXd::Zero(base.size()));
  const std::vector<ScoreTest> tests =
      screen(data, nominal.fit, nominal.weighting, {{hypothesisNamed("backlash"), 2}});
  const SetFit found = fitter.settled(std::move(fitter.extended(nominal, tests).front()));
  const double noise = data.channels()[1].noise;
  ASSERT_LT(squaresOf(data, found.fit.e).meanSquare(1), 1.2 * noise * noise);
  EXPECT_GT(squaresOf(data, nominal.fit.e).meanSquare(1), 4.0 * noise * noise);
  EXPECT_GE(heldOutRatio(data, found, 1), 1.0);
  EXPECT_LT(heldOutRatio(data, found, 1), 1.3);
}

/// Laws with corners make derivatives wrong. One step without a fold would then land elsewhere.
TEST(HeldOut, HardlyDependsOnTheDerivativesOfTheFit) {
  const Planted planted(4);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel base(planted.robot, jointScales(planted.evidence, planted.robot));
  SetFit sound = SetFitter(data).nominal(base, Eigen::VectorXd::Zero(base.size()));
  const auto excess = [&] {
    const Eigen::VectorXd w = sound.weighting.weights;
    return w.cwiseProduct(heldOut(data, sound.fit, sound.weighting)).squaredNorm() -
           w.cwiseProduct(sound.fit.e).squaredNorm();
  };
  const double right = excess();
  ASSERT_GT(right, 0.0);
  sound.fit.jacobian *= 0.5;  // steps of twice the length
  EXPECT_NEAR(excess(), right, 0.1 * right);
}

std::vector<Evidence> recordings(int count) {
  std::vector<Evidence> all;
  for (int k = 0; k < count; ++k)
    all.push_back(Planted(10 + static_cast<unsigned>(k), {}, 0, 5.0).evidence[0]);
  return all;
}

TEST(Folds, AreWholeRecordingsWhereThereAreEnough) {
  const auto foldsOf = [](const FitData& data, int recording) {
    std::set<int> folds;
    for (Eigen::Index i = data.first(recording); i < data.size(); ++i)
      if (recording + 1 == data.recordings() || i < data.first(recording + 1))
        folds.insert(data.fold(data.block()[static_cast<std::size_t>(i)]));
    return folds;
  };
  const std::vector<Evidence> few = recordings(kWholeFolds - 1), many = recordings(kWholeFolds);
  const FitData blocks(few, raven(), 0.0, EncoderZeros::kKnown, 2);
  const FitData whole(many, raven(), 0.0, EncoderZeros::kKnown, 2);
  EXPECT_EQ(blocks.folds(), kFolds);
  EXPECT_GT(foldsOf(blocks, 0).size(), 3U);
  EXPECT_EQ(whole.folds(), kWholeFolds);
  for (int r = 0; r < kWholeFolds; ++r) EXPECT_EQ(foldsOf(whole, r), std::set<int>{r});
}

/// Otherwise a fit would make the best-fitting recording perfect instead of mending the others.
TEST(Weights, AreThoseOfTheSensorInWhicheverRecording) {
  const std::vector<Evidence> two = recordings(2);
  const FitData data(two, raven(), 0.0, EncoderZeros::kKnown, 2);
  Eigen::VectorXd e = Eigen::VectorXd::Constant(data.size(), 1e-3);
  e.head(data.first(1)) *= 20.0;
  const Eigen::VectorXd weights = weightsFor(data, e);
  EXPECT_EQ(data.sensors() * 2, static_cast<int>(data.channels().size()));
  std::vector<double> of_sensor(static_cast<std::size_t>(data.sensors()), 0.0);
  for (Eigen::Index i = 0; i < data.size(); ++i) {
    const int channel = data.channel()[static_cast<std::size_t>(i)];
    double& own = of_sensor[static_cast<std::size_t>(data.sensorOf()[static_cast<std::size_t>(channel)])];
    if (own == 0.0) own = weights[i];
    EXPECT_EQ(weights[i], own);
  }
}

}  // namespace
}  // namespace capstan::diagnosis
