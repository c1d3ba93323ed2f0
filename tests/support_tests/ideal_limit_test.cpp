// What an observer with the true model could find.
#include "tests/support/planted_study/ideal_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support_tests/planted_robots.h"

namespace capstan::study {
namespace {

struct Drawn {
  test::PlantedCase of;
  test::Truth truth;
};

Drawn drawnCase(test::Effect effect, int joint, double magnitude, bool textured = false) {
  test::DrawOptions options = test::optionsFor(test::raven(), false);
  options.effect = effect;
  options.joint = joint;
  options.size = 0.5;
  options.duration = 20.0;
  options.textured = textured;
  Drawn drawn;
  drawn.of = test::draw(4, options);
  drawn.of.load = {};
  drawn.truth = test::truthOf(drawn.of);
  drawn.truth.items[0].planted.magnitude = magnitude;
  return drawn;
}

double deflectionOf(const Drawn& drawn) {
  return IdealObserver(drawn.of, drawn.truth, 3.0).deflection(drawn.truth.items[0].planted);
}

/// The encoders tell where the arm is, whatever has drifted: an offset of what n pictures show is found like
/// the mean of 3 n numbers, D² = n |offset|² / (σ²/3), σ² the summed variances of the axes.
TEST(IdealLimit, OfACameraOffsetIsThatOfAMean) {
  const Drawn drawn = drawnCase(test::Effect::kCameraOffset, 0, 1e-3);
  const double sigma = test::StereoPair(Eigen::Vector3d::Zero(), drawn.of.sensors).sigma();
  const double pictures = drawn.of.sensors.frame_rate * drawn.of.duration;
  const double mean = std::sqrt(3.0 * pictures) * 1e-3 / sigma;
  EXPECT_LT(deflectionOf(drawn), 1.01 * mean);
  EXPECT_GT(deflectionOf(drawn), 0.9 * mean);
}

/// More viscous friction is what drift makes, too: however long the recording, an observer who knows no
/// more than that ln F_v spreads by ln 2/√12 cannot be surer than that.
TEST(IdealLimit, AgeingHidesWhatLooksLikeIt) {
  const Drawn plain = drawnCase(test::Effect::kViscousFriction, 2, 0.0);
  const double viscous = plain.truth.robot.joints[1].friction.viscous;
  Drawn drawn = drawnCase(test::Effect::kViscousFriction, 2, 0.05 * viscous);
  drawn.of.duration = 2000.0;
  const double spreads = 0.05 / (std::log(2.0) / std::sqrt(12.0));
  EXPECT_LT(deflectionOf(drawn), 1.05 * spreads);
  EXPECT_GT(deflectionOf(drawn), 0.5 * spreads);
}

TEST(IdealLimit, GrowsWithTheEffectAndShrinksWithTexture) {
  const double one = deflectionOf(drawnCase(test::Effect::kAsymmetricFriction, 2, 0.01));
  EXPECT_NEAR(deflectionOf(drawnCase(test::Effect::kAsymmetricFriction, 2, 0.02)), 2.0 * one, 0.02 * one);
  // Known to within the texture's spread of 0.026, however well the sensors show it.
  const double textured = deflectionOf(drawnCase(test::Effect::kAsymmetricFriction, 2, 0.01, true));
  EXPECT_LT(textured, 1.02 * 0.01 / std::sqrt(7e-4));
  EXPECT_GT(one, 2.0 * textured);
}

TEST(IdealLimit, IsWhereTheDeflectionIsSignificant) {
  const Drawn offset = drawnCase(test::Effect::kCameraOffset, 0, 1e-3);
  IdealObserver observer(offset.of, offset.truth, 3.0);
  test::Planted planted = offset.truth.items[0].planted;
  // Linear: the size goes with the deflection.
  const double whole = observer.deflection(planted);
  EXPECT_NEAR(observer.limit(planted, 0.5).size, 0.5 * kHalfFound / whole, 0.05 * 0.5 * kHalfFound / whole);
  planted.magnitude *= 2.0 / whole;  // not significant
  EXPECT_NEAR(observer.limit(planted, 0.5).size, 0.5 * kHalfFound / 2.0, 1e-3);
  planted.magnitude = 0.0;
  EXPECT_TRUE(std::isnan(observer.limit(planted, 0.5).size));
}

/// Lost pretension shows by what it leaves: no multiple of less lost, which is looked for.
TEST(IdealLimit, OfSlackIsThatOfLessSlack) {
  const Drawn drawn = drawnCase(test::Effect::kSlack, 2, 1.0);
  IdealObserver observer(drawn.of, drawn.truth, 3.0);
  test::Planted planted = drawn.truth.items[0].planted;
  const IdealObserver::Limit limit = observer.limit(planted, 0.5);
  const double whole = observer.deflection(planted);
  planted.magnitude *= limit.share;
  EXPECT_NEAR(observer.deflection(planted), kHalfFound, 0.05 * kHalfFound);
  EXPECT_GT(limit.share, 2.0 * kHalfFound / whole);
  EXPECT_LT(limit.size, 0.1);  // just visible beside texture and noise
}

}  // namespace
}  // namespace capstan::study
