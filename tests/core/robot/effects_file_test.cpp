// Effects and drives in robot files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/robot/chain/chain_model.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using ::testing::HasSubstr;

std::string leftText() { return base::readTextFile(testing::robotFile("left")); }
int lineCount(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// Text of the left arm with `effects` behind it.
std::string with(const std::string& effects) { return leftText() + effects; }

std::string play(const std::string& joint, const std::string& values, const std::string& name = "backlash") {
  return "effects:\n  - effect: " + name + "\n    joint: " + joint + "\n    values: " + values + "\n";
}

base::InputFault faultOf(const std::string& text) {
  try {
    parseDescription(text, "robot.yaml");
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "robot.yaml");
    EXPECT_GT(error.fault().line, 0);
    EXPECT_FALSE(error.fault().remedy.empty());
    return error.fault();
  }
  ADD_FAILURE() << "the file was taken";
  return {};
}

/// Every effect that `drive` can have, once, with numbers that have no short decimal form.
std::vector<Effect> everyEffect(DriveType drive) {
  std::vector<Effect> effects;
  for (const EffectFacts& facts : effectFacts()) {
    if (!(drive == DriveType::kCable ? facts.cable : facts.rigid)) continue;
    Effect effect{std::string(facts.name), facts.whole ? 0 : 2, {}};
    for (const EffectParameter& p : facts.parameters)
      effect.values.push_back(
          {std::string(p.name), p.name == "other" ? 1.0 : p.low + (p.high - p.low) / 1.7});
    effects.push_back(effect);
  }
  return effects;
}

TEST(EffectsFile, everyEffectIsReadAgainToTheLastBit) {
  for (const DriveType drive : {DriveType::kCable, DriveType::kRigid}) {
    Description robot = testing::raven();
    robot.drive = drive;
    robot.effects = everyEffect(drive);
    const std::string text = formatDescription(robot);
    const Description again = parseDescription(text, "again");
    EXPECT_EQ(formatDescription(again), text);
    EXPECT_EQ(again.drive, drive);
    ASSERT_EQ(again.effects.size(), robot.effects.size());
    for (std::size_t i = 0; i < robot.effects.size(); ++i) {
      const Effect &was = robot.effects[i], &is = again.effects[i];
      EXPECT_EQ(is.effect, was.effect);
      EXPECT_EQ(is.joint, was.joint);
      ASSERT_EQ(is.values.size(), was.values.size());
      for (const EffectValue& value : was.values) EXPECT_EQ(is[value.parameter], value.value) << was.effect;
    }
  }
}

TEST(EffectsFile, aNominalCableRobotSaysNothingOfThem) {
  const std::string text = formatDescription(testing::raven());
  EXPECT_EQ(text.find("effects"), std::string::npos);
  EXPECT_EQ(text.find("drive:"), std::string::npos);
  EXPECT_EQ(parseDescription(leftText() + "drive: cable\neffects: []\n", "robot").effects.size(), 0U);
}

TEST(EffectsFile, valuesAreAMapAsAPersonWritesIt) {
  const Description robot = parseDescription(with(play("2", "{half_width: 4.5e-4}")), "robot.yaml");
  ASSERT_EQ(robot.effects.size(), 1U);
  EXPECT_EQ(robot.effects[0]["half_width"], 4.5e-4);
  EXPECT_EQ(ChainModel(robot).numbers.joints[1].play, 4.5e-4);
  EXPECT_EQ(ChainModel(robot).shape.laws[1], static_cast<unsigned>(kLawPlay));
}

TEST(EffectsFile, driveIsSpelled) {
  EXPECT_TRUE(ChainModel(parseDescription(leftText() + "drive: rigid\n", "robot")).shape.rigid);
  EXPECT_FALSE(ChainModel(testing::raven()).shape.rigid);
  const base::InputFault fault = [] {
    try {
      parseDescription(leftText() + "drive: belt\n", "robot.yaml");
    } catch (const base::InputError& error) {
      return error.fault();
    }
    return base::InputFault{};
  }();
  EXPECT_EQ(fault.key, "drive");
  EXPECT_EQ(fault.value, "belt");
  EXPECT_THAT(fault.reason, HasSubstr("cable, rigid"));
}

TEST(EffectsFile, anUnknownNameIsComparedWithTheKnown) {
  const std::string text = with(play("2", "{half_width: 4.5e-4}", "backlahs"));
  const base::InputFault fault = faultOf(text);
  EXPECT_EQ(fault.key, "effects[0].effect");
  EXPECT_EQ(fault.value, "backlahs");
  EXPECT_EQ(fault.line, lineCount(leftText()) + 2);
  EXPECT_EQ(fault.remedy, "Did you mean backlash?");
  EXPECT_THAT(faultOf(with(play("2", "{}", "rust"))).remedy, HasSubstr("pulley_radius, cable_coupling"));
}

TEST(EffectsFile, jointsAreTheRobots) {
  const base::InputFault fault = faultOf(with(play("4", "{half_width: 4.5e-4}")));
  EXPECT_EQ(fault.key, "effects[0].joint");
  EXPECT_EQ(fault.value, "4");
  EXPECT_EQ(fault.remedy, "Write 1 to 3");
  EXPECT_EQ(faultOf(with(play("0", "{half_width: 4.5e-4}"))).key, "effects[0].joint");
  EXPECT_EQ(faultOf(with(play("1", "{mass: 0.1}", "payload"))).remedy, "Write 0");
  EXPECT_EQ(faultOf(with(play("2", "{added: 0.1, other: 2}", "cable_coupling"))).key,
            "effects[0].values.other");
  EXPECT_EQ(faultOf(with(play("2", "{added: 0.1, other: 1.5}", "cable_coupling"))).value, "1.5");
  EXPECT_EQ(faultOf(with(play("2", "{added: 0.1, other: 5}", "cable_coupling"))).remedy,
            "Write 1 to 3, but not 2");
}

TEST(EffectsFile, numbersAreAllThereKnownAndWithinBounds) {
  const base::InputFault missing = faultOf(with(play("2", "{force: 3}", "cable_hysteresis")));
  EXPECT_EQ(missing.key, "effects[0].values.yield");
  EXPECT_THAT(missing.reason, HasSubstr("missing"));
  const base::InputFault unknown = faultOf(with(play("2", "{half_widht: 4.5e-4}")));
  EXPECT_EQ(unknown.key, "effects[0].values.half_widht");
  EXPECT_EQ(unknown.remedy, "Did you mean half_width?");
  const base::InputFault large = faultOf(with(play("2", "{half_width: 0.5}")));
  EXPECT_EQ(large.key, "effects[0].values.half_width");
  EXPECT_EQ(large.value, "0.5");
  EXPECT_EQ(large.line, lineCount(leftText()) + 4);
  EXPECT_THAT(large.reason, HasSubstr("0 … 0.1 m"));
}

TEST(EffectsFile, numbersOfLaterVersionsMayBeOmitted) {
  const std::string items =
      "effects:\n"
      "  - {effect: backlash, joint: 2, values: {half_width: 4.5e-4}}\n"
      "  - {effect: position_stiffness, joint: 2, values: {share: 0.2}}\n"
      "  - {effect: homing_offset, joint: 1, values: {offset: 0.01}}\n";
  const Description robot = parseDescription(with(items), "robot.yaml");
  const ChainModel model(robot);
  EXPECT_EQ(model.numbers.joints[1].play_damping, 0.0);
  EXPECT_EQ(model.numbers.joints[1].length_share, 1.0);
  EXPECT_DOUBLE_EQ(model.numbers.joints[0].homing, robot.joints[0].homing + 0.01);
  EXPECT_EQ(model.numbers.joints[1].homing, robot.joints[1].homing);
  const std::string wild = play("2", "{half_width: 4.5e-4, damping: 3}");
  EXPECT_EQ(faultOf(with(wild)).key, "effects[0].values.damping");
}

TEST(EffectsFile, theDriveCanHaveIt) {
  const base::InputFault motor = faultOf(with(play("1", "{share: 0.1}", "actuator_gain")));
  EXPECT_EQ(motor.key, "effects[0].effect");
  EXPECT_THAT(motor.reason, HasSubstr("drive is cable"));
  EXPECT_THAT(motor.remedy, HasSubstr("drive: rigid"));
  EXPECT_THAT(faultOf(with("drive: rigid\n" + play("1", "{half_width: 1e-4}"))).reason,
              HasSubstr("drive is rigid"));
}

TEST(EffectsFile, oneLawIsOnceInAJointAndNumbersAddUp) {
  const std::string item = "  - {effect: backlash, joint: 2, values: {half_width: 4.5e-4}}\n";
  const base::InputFault fault = faultOf(with("effects:\n" + item + item));
  EXPECT_EQ(fault.key, "effects[1].effect");
  EXPECT_THAT(fault.reason, HasSubstr("already in joint 2"));
  const std::string wider = "  - {effect: pulley_radius, joint: 2, values: {share: 0.1}}\n";
  const Description robot = parseDescription(with("effects:\n" + wider + wider), "robot.yaml");
  EXPECT_DOUBLE_EQ(ChainModel(robot).numbers.joints[1].link_radius, robot.drives[1].link_radius * 1.21);
}

TEST(EffectsFile, togetherTheyLeaveARobotThatCanMove) {
  const std::string off = "{added: -0.14545, other: 1}";  // A(2, 1) of the file taken away: sound
  EXPECT_NO_THROW(parseDescription(with(play("2", off, "cable_coupling")), "robot.yaml"));
  const std::string both = play("2", "{added: 9.85455, other: 1}", "cable_coupling") +
                           "  - {effect: cable_coupling, joint: 1, values: {added: 0.1, other: 2}}\n";
  EXPECT_THAT(faultOf(with(both)).reason, HasSubstr("coupling that cannot be inverted"));
  EXPECT_THAT(faultOf(with(play("3", "{added: -3}", "inertia"))).reason, HasSubstr("inertia"));
}

}  // namespace
}  // namespace capstan::robot
