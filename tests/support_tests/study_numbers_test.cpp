// What was planted in the words of a cause.
#include <cmath>
#include <numbers>

#include "core/robot/effects.h"
#include "tests/support_tests/study_outcomes.h"

namespace capstan::study {
namespace {

HiddenTruth truthWith(const test::Truth::Item& planted) { return {{planted}, {}, 30.0, NAN}; }

NumberCheck only(const HiddenTruth& truth, const NamedCause& found) {
  const auto checks = checkNumbers(truth, 0, found);
  EXPECT_EQ(checks.size(), 1U);
  return checks.front();
}

TEST(StudyNumbers, AreTheEffectsOwn) {
  for (const test::EffectFacts& facts : test::allEffects()) {
    if (!facts.covered) continue;
    const robot::EffectFacts* registered = robot::effectNamed(facts.name);
    ASSERT_NE(registered, nullptr) << facts.name;
    NamedCause found = cause(std::string(facts.name), 1);
    for (const auto& parameter : registered->parameters)
      found.numbers.push_back({std::string(parameter.name), 1.0, 0.1});
    for (const NumberCheck& check : checkNumbers(truthWith(item(facts.name, 1, 0.5)), 0, found))
      EXPECT_TRUE(std::isfinite(check.found) && std::isfinite(check.sigma))
          << facts.name << " has no number " << check.name;
  }
}

TEST(StudyNumbers, InsideMeansWithin196Sigmas) {
  EXPECT_TRUE((NumberCheck{"x", 1.0, 1.19, 0.1}.inside()));
  EXPECT_FALSE((NumberCheck{"x", 1.0, 1.20, 0.1}.inside()));
  EXPECT_FALSE((NumberCheck{"x", 0.3, -0.3, 0.1}.inside()));  // wrong sign
  EXPECT_TRUE((NumberCheck{"x", 0.3, 0.3, 0.0}.inside()));
  EXPECT_FALSE((NumberCheck{"x", 0.3, 0.31, 0.0}.inside()));
  EXPECT_FALSE((NumberCheck{"x", 0.3, NAN, 0.1}.inside()));
  EXPECT_FALSE((NumberCheck{"x", 0.3, 0.3, NAN}.inside()));
}

TEST(StudyNumbers, AbsentNumbersAreOutside) {
  for (const char* effect : {"backlash", "cable_creep", "capstan_eccentricity", "camera_offset", "payload"})
    for (const NumberCheck& check : checkNumbers(truthWith(item(effect, 1, 0.5)), 0, cause(effect, 1)))
      EXPECT_FALSE(check.inside()) << effect << " " << check.name;
}

TEST(StudyNumbers, VectorsCountAlongThePlantedAxis) {
  auto planted = item("camera_rotation", 0, 0.5, 0.02);
  planted.planted.axis = Eigen::Vector3d(3.0, 0.0, 4.0) / 5.0;
  const NumberCheck check =
      only(truthWith(planted),
           cause("camera_rotation", 0, {{"x", 0.012, 0.001}, {"y", 0.5, 0.2}, {"z", 0.016, 0.002}}));
  EXPECT_NEAR(check.found, 0.02, 1e-15);
  EXPECT_NEAR(check.sigma, std::hypot(0.6 * 0.001, 0.8 * 0.002), 1e-15);
  EXPECT_TRUE(check.inside());
}

TEST(StudyNumbers, WavesCountByAmplitude) {
  auto planted = item("position_friction", 2, 0.5, 0.5);
  planted.planted.signature = 0.9;
  planted.planted.phase = 1.0;
  const auto checks = checkNumbers(
      truthWith(planted), 0,
      cause("position_friction", 2, {{"sine", 0.3, 0.01}, {"cosine", 0.4, 0.02}, {"period", 1.0, 0.1}}));
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_NEAR(checks[0].found, 0.5, 1e-15);
  EXPECT_NEAR(checks[0].sigma, std::hypot(0.6 * 0.01, 0.8 * 0.02), 1e-15);
  EXPECT_EQ(checks[1].planted, 0.9);
}

/// The texture is of the same kind: what is found is the sum of both.
TEST(StudyNumbers, TextureAddsToWhatWasPlanted) {
  HiddenTruth truth = truthWith(item("asymmetric_friction", 2, 0.5, 0.3));
  truth.texture = {item("asymmetric_friction", 1, 0.0, 0.5).planted,
                   item("asymmetric_friction", 2, 0.0, -0.04).planted,
                   item("stribeck_friction", 2, 0.0, 0.04).planted};
  EXPECT_NEAR(only(truth, cause("asymmetric_friction", 2, {{"share", 0.0, 1.0}})).planted, 0.26, 1e-15);
  truth = truthWith(item("capstan_eccentricity", 2, 0.5, 3e-3));
  truth.texture = {item("capstan_eccentricity", 2, 0.0, 4e-3).planted};
  truth.texture.front().phase = 0.5 * std::numbers::pi;
  EXPECT_NEAR(only(truth, cause("capstan_eccentricity", 2)).planted, 5e-3, 1e-15);
}

TEST(StudyNumbers, SlackIsThePretensionThatIsLeft) {
  auto planted = item("slack", 2, 0.5, 1.2);
  planted.planted.signature = 1e-3;
  EXPECT_NEAR(only(truthWith(planted), cause("slack", 2)).planted, -0.2e-3, 1e-15);
}

TEST(StudyNumbers, CouplingNeedsTheOtherJoint) {
  auto planted = item("cable_coupling", 3, 0.5, 0.05);
  planted.planted.other = 0;
  const auto found = [](double other) {
    return cause("cable_coupling", 3, {{"added", 0.05, 0.01}, {"other", other, 0.0}});
  };
  EXPECT_TRUE(only(truthWith(planted), found(1.0)).inside());
  EXPECT_FALSE(only(truthWith(planted), found(2.0)).inside());
}

TEST(StudyNumbers, ASlipTakesItsTime) {
  auto planted = item("encoder_slip", 1, 0.5, 2.0);
  planted.planted.phase = 0.5;
  planted.planted.signature = 0.05;
  const auto at = [&](double time) {
    return checkNumbers(truthWith(planted), 0,
                        cause("encoder_slip", 1, {{"slip", 2.0, 0.1}, {"time", time, 0.01}}))[1];
  };
  EXPECT_TRUE(at(15.03).inside());
  EXPECT_TRUE(at(14.985).inside());
  EXPECT_FALSE(at(14.97).inside());
  EXPECT_FALSE(at(15.08).inside());
}

}  // namespace
}  // namespace capstan::study
