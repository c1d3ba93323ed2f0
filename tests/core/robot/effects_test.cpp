// The list of effects is complete and says of each what it is made of; an effect gives its numbers by name.
#include "core/robot/effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string_view> namesWhere(bool (*wanted)(const EffectFacts&)) {
  std::vector<std::string_view> names;
  for (const EffectFacts& facts : effectFacts())
    if (wanted(facts)) names.push_back(facts.name);
  return names;
}

TEST(Effects, AreThoseOfTheTask) {
  EXPECT_THAT(
      namesWhere([](const EffectFacts&) { return true; }),
      ElementsAre("pulley_radius", "cable_coupling", "homing_offset", "zero_drift", "encoder_slip",
                  "capstan_eccentricity", "cable_compliance", "cable_stiffening", "position_stiffness",
                  "backlash", "slack", "cable_hysteresis", "cable_creep", "stribeck_friction",
                  "asymmetric_friction", "asymmetric_viscosity", "viscous_friction", "load_friction",
                  "position_friction", "gravity_tilt", "payload", "inertia", "actuator_gain", "torque_offset",
                  "camera_latency", "camera_rotation", "camera_offset", "camera_scale", "sensor_sign"));
}

TEST(Effects, KnowTheirDrivesAndTheirJoints) {
  EXPECT_THAT(namesWhere([](const EffectFacts& facts) { return !facts.rigid; }),
              ElementsAre("pulley_radius", "cable_coupling", "homing_offset", "zero_drift", "encoder_slip",
                          "capstan_eccentricity", "cable_stiffening", "position_stiffness", "backlash",
                          "slack", "cable_hysteresis", "cable_creep"));
  EXPECT_THAT(namesWhere([](const EffectFacts& facts) { return !facts.cable; }),
              ElementsAre("asymmetric_viscosity", "actuator_gain", "torque_offset"));
  EXPECT_THAT(namesWhere([](const EffectFacts& facts) { return facts.whole; }),
              ElementsAre("gravity_tilt", "payload", "camera_latency", "camera_rotation", "camera_offset",
                          "camera_scale"));
}

TEST(Effects, SayWhatTheirNumbersAre) {
  const std::set<std::string_view> units = {
      "",         "rad",          "m",  "rad or m",     "rad/rad or m/rad",  "s", "m/N", "1/m^2", "N",
      "N*m or N", "rad/s or m/s", "kg", "kg*m^2 or kg", "N*m*s/rad or N*s/m"};
  for (const EffectFacts& facts : effectFacts()) {
    SCOPED_TRACE(facts.name);
    EXPECT_FALSE(facts.parameters.empty());
    std::set<std::string_view> names;
    for (const EffectParameter& parameter : facts.parameters) {
      SCOPED_TRACE(parameter.name);
      EXPECT_TRUE(names.insert(parameter.name).second);
      EXPECT_TRUE(units.contains(parameter.unit)) << parameter.unit;
      EXPECT_LT(parameter.low, parameter.high);
      EXPECT_FALSE(parameter.what.empty());
    }
  }
}

TEST(Effects, AreFoundByName) {
  for (const EffectFacts& facts : effectFacts()) EXPECT_EQ(effectNamed(facts.name), &facts);
  EXPECT_EQ(effectNamed("back_lash"), nullptr);
  EXPECT_EQ(effectNamed(""), nullptr);
}

TEST(Effects, GiveTheirNumbersByName) {
  const Effect creep{"cable_creep", 2, {{"time_constant", 1.5}, {"share", 0.25}}};
  EXPECT_EQ(creep["share"], 0.25);
  EXPECT_EQ(creep["time_constant"], 1.5);
}

TEST(Effects, RefuseNumbersThatTheyDoNotHave) {
  const Effect creep{"cable_creep", 2, {{"share", 0.25}}};
  try {
    creep["time_constant"];
    FAIL() << "a missing number was given";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "effects");
    EXPECT_EQ(error.fault().value, "cable_creep");
    EXPECT_THAT(error.what(), HasSubstr("`time_constant`"));
    EXPECT_THAT(error.what(), HasSubstr("Give all of its numbers: share, time_constant"));
  }
  const Effect misspelt{"cable_crepe", 2, {}};
  try {
    misspelt["share"];
    FAIL() << "a missing number was given";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cable_crepe"));
    EXPECT_THAT(error.what(), HasSubstr("Check the effect's name"));
  }
}

TEST(Effects, GoThroughAFile) {
  const Effect before{"stribeck_friction", 3, {{"excess", 0.75}, {"speed", 0.1}}};
  const auto after = base::readYaml<Effect>(base::writeYaml(before), "effect.yaml");
  EXPECT_EQ(after.effect, before.effect);
  EXPECT_EQ(after.joint, before.joint);
  ASSERT_EQ(after.values.size(), 2U);
  EXPECT_EQ(after["excess"], 0.75);
  EXPECT_EQ(after["speed"], 0.1);
}

/// Row of the manual's table of effects.
std::string rowOf(const EffectFacts& facts, const EffectParameter& number) {
  const char* drive = facts.cable && facts.rigid ? "both" : facts.cable ? "cable" : "rigid";
  return fmt::format("| `{}` | {} | `{}` | {} | {:g} … {:g} | {} | {} |", facts.name,
                     facts.whole ? "0" : drive, number.name, number.unit.empty() ? "–" : number.unit,
                     number.low, number.high,
                     number.omitted ? fmt::format("{:g}", *number.omitted) : "required", number.what);
}

TEST(Effects, AreInTheManualWithAllTheirNumbers) {
  const auto page =
      std::filesystem::path(testing::robotFile("left")).parent_path().parent_path() / "manual" / "effects.md";
  const std::string text = base::readTextFile(page.string());
  for (const EffectFacts& facts : effectFacts())
    for (const EffectParameter& number : facts.parameters)
      EXPECT_THAT(text, HasSubstr(rowOf(facts, number) + "\n"));
}

}  // namespace
}  // namespace capstan::robot
