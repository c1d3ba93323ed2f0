// What is drawn from a seed, and how large it is.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/planted/excitation.h"
#include "tests/support_tests/planted_robots.h"

namespace capstan::test {
namespace {

TEST(PlantedEffects, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const EffectFacts& facts : allEffects()) {
    EXPECT_EQ(&factsOf(facts.effect), &facts);
    EXPECT_EQ(effectNamed(facts.name), &facts);
    EXPECT_TRUE(names.insert(facts.name).second);
    EXPECT_TRUE(facts.cable || facts.rigid);
  }
  EXPECT_EQ(effectNamed("none"), nullptr);
  EXPECT_EQ(names.size(), 31U);
}

TEST(PlantedCase, EverythingIsDrawnAndOnlyWhereItMakesSense) {
  for (const bool rigid : {false, true}) {
    const DrawOptions options = optionsFor(rigid ? rigidRobot("rigid_arm") : raven(), rigid);
    std::map<Effect, int> drawn;
    int textured = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
      const PlantedCase one = draw(seed, options);
      ASSERT_EQ(one.effects.size(), 1U);
      const ChosenEffect& chosen = one.effects.front();
      ++drawn[chosen.effect];
      const EffectFacts& facts = factsOf(chosen.effect);
      EXPECT_TRUE(facts.covered && (rigid ? facts.rigid : facts.cable)) << facts.name;
      EXPECT_EQ(chosen.joint == 0, facts.whole);
      EXPECT_LE(chosen.joint, 3);
      EXPECT_GE(chosen.size, 0.1);
      EXPECT_LE(chosen.size, 1.0);
      EXPECT_GE(one.duration, 20.0);
      EXPECT_LE(one.duration, 40.0);
      EXPECT_EQ(one.sensors.motor_encoders, !rigid);
      textured += one.textured;
    }
    for (const EffectFacts& facts : allEffects())
      EXPECT_EQ(drawn.contains(facts.effect), facts.covered && (rigid ? facts.rigid : facts.cable))
          << facts.name;
    EXPECT_NEAR(textured, 300, 60);
  }
}

TEST(PlantedCase, StiffJointsHaveNoEffectsOfForce) {
  const DrawOptions options = optionsFor(raven(), false);
  EXPECT_EQ(jointsFor(Effect::kStribeckFriction, options), (std::vector<int>{2, 3}));
  EXPECT_EQ(jointsFor(Effect::kPulleyRadius, options), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(jointsFor(Effect::kCableCoupling, options), (std::vector<int>{2, 3}));
  EXPECT_EQ(jointsFor(Effect::kPayload, options), (std::vector<int>{0}));
  EXPECT_TRUE(jointsFor(Effect::kCableCompliance, options).empty());
}

TEST(PlantedCase, NoneTwoAndUncovered) {
  DrawOptions options = optionsFor(raven(), false);
  options.effects = 0;
  EXPECT_TRUE(draw(3, options).effects.empty());
  options.effects = 2;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const PlantedCase two = draw(seed, options);
    ASSERT_EQ(two.effects.size(), 2U);
    EXPECT_NE(two.effects[0].effect, two.effects[1].effect) << seed;
  }
  options.effects = 1;
  options.uncovered = true;
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    EXPECT_FALSE(factsOf(draw(seed, options).effects.front().effect).covered);
}

TEST(PlantedCase, WhatMakesNoSenseIsRefused) {
  DrawOptions options = optionsFor(raven(), false);
  options.effect = Effect::kActuatorGain;
  EXPECT_THROW(draw(1, options), std::invalid_argument);
  options.effect = Effect::kStribeckFriction;
  options.joint = 1;
  EXPECT_THROW(draw(1, options), std::invalid_argument);
  options.joint = 2;
  EXPECT_EQ(draw(1, options).effects.front().joint, 2);
}

TEST(PlantedCase, AgeingMovesEveryParameterByTensOfPerCent) {
  const robot::Description nominal = raven();
  base::Random random(8);
  double least = 1.0, most = 1.0;
  for (int k = 0; k < 50; ++k) {
    const robot::Description old = worn(nominal, random);
    for (std::size_t i = 0; i < 3; ++i)
      for (const double ratio :
           {old.drives[i].cable_stiffness / nominal.drives[i].cable_stiffness,
            old.drives[i].cable_damping / nominal.drives[i].cable_damping,
            old.drives[i].motor_friction.coulomb / nominal.drives[i].motor_friction.coulomb,
            old.joints[i].friction.coulomb / nominal.joints[i].friction.coulomb,
            old.joints[i].friction.viscous / nominal.joints[i].friction.viscous,
            old.joints[i].link.mass / nominal.joints[i].link.mass}) {
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
    EXPECT_NE(old.joints[0].link.centre_of_mass, nominal.joints[0].link.centre_of_mass);
    EXPECT_EQ(old.drives[1].link_radius, nominal.drives[1].link_radius);
    EXPECT_EQ(old.coupling, nominal.coupling);
  }
  EXPECT_GT(least, 0.69);
  EXPECT_LT(least, 0.75);
  EXPECT_GT(most, 1.3);
  EXPECT_LT(most, 1.41);
}

/// Everything that sizes are measured with, of one robot under one motion.
struct Bench {
  Bench(const robot::Description& nominal, bool rigid) : robot(nominal), parameters(nominal, rigid) {
    base::Random random(6);
    const Excitation excitation(robot, 5.0, random);
    texture = backgroundTexture(parameters, random);
    Plant plant(parameters, {});
    const Joints push{0.3 * parameters.coulomb[0], 0.3 * parameters.coulomb[1], 0.3 * parameters.coulomb[2]};
    const ExternalLoad load(push, random);
    motion = drive(
        plant, robot, {}, [&](double t) { return excitation.at(t); }, [&](double t) { return load.at(t); },
        {5.0, 0.5});
  }

  robot::Description robot;
  PlantParameters parameters;
  std::vector<Planted> texture;
  SensorOptions sensors;
  PlantedMotion motion;
};

/// Of these drift and texture hide so much that the largest of them is just less than visible on the last
/// joint.
const std::set<Effect> kHidden = {Effect::kSensorSign, Effect::kAsymmetricFriction, Effect::kNonlinearSpring};

TEST(PlantedCase, SizeOneShows) {
  for (const bool rigid : {false, true}) {
    const Bench bench(rigid ? rigidRobot("rigid_arm") : raven(), rigid);
    const Visibility visibility(bench.robot, bench.robot, bench.parameters.rigid, {}, bench.texture,
                                bench.sensors, bench.motion);
    base::Random random(9);
    for (const EffectFacts& facts : allEffects()) {
      const auto joints = jointsFor(facts.effect, optionsFor(bench.robot, rigid));
      if (joints.empty()) continue;
      const int joint = std::max(joints.back() - 1, 0);
      const Planted most = largestPlausible(facts.effect, joint, bench.parameters, bench.robot, random);
      const Sized large = sizedTo(1.0, most, visibility);
      EXPECT_GT(large.visibility, kHidden.contains(facts.effect) ? 0.6 : 1.0) << facts.name;
      EXPECT_LT(large.visibility, 12.6) << facts.name;
      EXPECT_LE(std::abs(large.planted.magnitude), std::abs(most.magnitude)) << facts.name;
    }
  }
}

TEST(PlantedCase, ATenthOfLargeIsJustVisible) {
  const Bench bench(raven(), false);
  const Visibility visibility(bench.robot, bench.robot, bench.parameters.rigid, {}, bench.texture,
                              bench.sensors, bench.motion);
  base::Random random(9);
  for (const Effect effect :
       {Effect::kPulleyRadius, Effect::kBacklash, Effect::kSlack, Effect::kCableCoupling}) {
    const Planted most = largestPlausible(effect, 1, bench.parameters, bench.robot, random);
    EXPECT_NEAR(sizedTo(0.1, most, visibility).visibility, 1.0, 0.26) << factsOf(effect).name;
    const double large = sizedTo(1.0, most, visibility).visibility;
    if (effect == Effect::kSlack)  // without a play it shows less
      EXPECT_GT(large, 3.0);
    else
      EXPECT_NEAR(large, 10.0, 2.6) << factsOf(effect).name;
  }
}

/// A table with every tenth row does not say what torque a rigid drive had between them.
TEST(PlantedCase, TorquesBetweenTheRowsHideEffectsOfARigidDrive) {
  const Bench bench(rigidRobot("rigid_arm"), true);
  const auto visibilityOfGain = [&](int row_period) {
    SensorOptions sensors = bench.sensors;
    sensors.row_period = row_period;
    const Visibility visibility(bench.robot, bench.robot, true, {}, bench.texture, sensors, bench.motion);
    return visibility.of({.effect = Effect::kActuatorGain, .joint = 1, .magnitude = 0.05});
  };
  const double every_row = visibilityOfGain(1), every_fourth = visibilityOfGain(4),
               every_tenth = visibilityOfGain(10);
  EXPECT_LT(every_fourth, 0.9 * every_row);
  EXPECT_LT(every_tenth, 0.7 * every_fourth);
  EXPECT_GT(every_tenth, 0.0);
}

/// A camera offset, which encoders tell from all drift, counts whole; friction a little stronger and 2 % of
/// asymmetry do not, since robots without a fault have as much; of 60 % of asymmetry all but 4 do.
TEST(PlantedCase, WhatAgeingAndTextureMakeIsNotVisible) {
  const Bench bench(raven(), false);
  const Visibility visibility(bench.robot, bench.robot, false, {}, bench.texture, bench.sensors,
                              bench.motion);
  Planted planted;
  planted.effect = Effect::kCameraOffset;
  planted.magnitude = 5e-3;
  const double sigma = StereoPair(Eigen::Vector3d::Zero(), bench.sensors).sigma();
  EXPECT_NEAR(visibility.of(planted), 5e-3 / sigma, 0.1 * 5e-3 / sigma);
  planted.joint = 1;
  planted.effect = Effect::kViscousFriction;
  planted.magnitude = 0.2 * bench.parameters.viscous[1];
  EXPECT_LT(visibility.of(planted), 0.1);
  planted.effect = Effect::kAsymmetricFriction;
  planted.magnitude = 0.02;
  EXPECT_LT(visibility.of(planted), 0.1);
  planted.magnitude = 0.3;
  const double less = visibility.of(planted);
  planted.magnitude = 0.6;
  EXPECT_NEAR(visibility.of(planted) / less, (0.6 - 0.04) / (0.3 - 0.04), 0.1);
}

TEST(PlantedCase, SizesRunFromJustVisibleToLarge) {
  EXPECT_NEAR(visibilityOf(0.1, 1e4), 1.0, 1e-12);
  EXPECT_NEAR(visibilityOf(0.5, 1e4), 5.0, 1e-12);
  EXPECT_NEAR(visibilityOf(1.0, 1e4), 10.0, 1e-12);
  EXPECT_NEAR(visibilityOf(30.0, 1e4), 300.0, 1e-12);
  EXPECT_NEAR(visibilityOf(0.1, 4.0), 1.0, 1e-12);  // never more than 4 times noise and texture
  EXPECT_NEAR(visibilityOf(1.0, 4.0), 4.0, 1e-12);
  EXPECT_NEAR(visibilityOf(0.5, 0.6), 0.3, 1e-12);
}

TEST(PlantedCase, RecordingAndTruthAreOfOneCase) {
  DrawOptions options = optionsFor(raven(), false);
  options.effect = Effect::kPulleyRadius;
  options.joint = 2;
  options.size = 0.4;
  options.duration = 3.0;
  const PlantedCase drawn = draw(5, options);
  const auto [recording, truth] = recordWithTruth(drawn);
  EXPECT_EQ(recording.table.q, record(drawn).table.q);
  ASSERT_EQ(truth.items.size(), 1U);
  EXPECT_EQ(truth.items[0].effect, "pulley_radius");
  EXPECT_EQ(truth.items[0].joint, 2);
  EXPECT_EQ(truth.items[0].planted.magnitude, truthOf(drawn).items[0].planted.magnitude);
  EXPECT_EQ(robot::formatDescription(recording.robot), robot::formatDescription(options.robot));
}

}  // namespace
}  // namespace capstan::test
