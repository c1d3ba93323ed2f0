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

double deflectionOf(const Drawn& drawn) { return study::deflectionOf(drawn.of, drawn.truth, 3.0); }

/// The encoders tell where the arm is, whatever has aged: an offset of what n pictures show is found like the
/// mean of 3 n numbers, D² = n |offset|² / (σ²/3), σ² the summed variances of the axes.
TEST(IdealLimit, OfACameraOffsetIsThatOfAMean) {
  const Drawn drawn = drawnCase(test::Effect::kCameraOffset, 0, 1e-3);
  const double sigma = test::StereoPair(Eigen::Vector3d::Zero(), drawn.of.sensors).sigma();
  const double pictures = drawn.of.sensors.frame_rate * drawn.of.duration;
  const double mean = std::sqrt(3.0 * pictures) * 1e-3 / sigma;
  EXPECT_LT(deflectionOf(drawn), 1.01 * mean);
  EXPECT_GT(deflectionOf(drawn), 0.9 * mean);
}

/// More viscous friction is what ageing makes, too: however long the recording, an observer who knows no
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
  EXPECT_NEAR(idealLimit(0.5, kHalfFound), 0.5, 1e-15);
  EXPECT_NEAR(idealLimit(0.5, 10.0 * kHalfFound), 0.05, 1e-15);
}

}  // namespace
}  // namespace capstan::study
