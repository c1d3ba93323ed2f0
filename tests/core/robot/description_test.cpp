#include "core/robot/description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/base/yaml.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using ::testing::HasSubstr;

std::string leftText() { return base::readTextFile(testing::robotFile("left")); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

int lineOf(const std::string& text, const std::string& part) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

base::InputFault faultOf(const std::string& text) {
  try {
    parseDescription(text, "robot.yaml");
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("robot.yaml:"));
    return error.fault();
  }
  ADD_FAILURE() << "the file was taken";
  return {};
}

TEST(RobotFile, leftArmHoldsTheConstants) {
  const Description robot = testing::raven("left");
  ASSERT_EQ(robot.size(), 3);
  const std::array alpha_deg = {0.0, 75.0, 128.0}, theta_deg = {205.0, 180.0, 90.0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(robot.joints[i].dh.alpha, base::toRadians(alpha_deg[i]));
    EXPECT_DOUBLE_EQ(robot.joints[i].dh.theta, base::toRadians(theta_deg[i]));
    EXPECT_EQ(robot.drives[i].gear_ratio, 49.0 / 4.0);
    EXPECT_EQ(robot.drives[i].motor_capstan_radius, 5.675e-3);
    EXPECT_EQ(robot.drives[i].motor_inertia, 2.847e-4);
  }
  EXPECT_DOUBLE_EQ(robot.joints[1].homing, base::toRadians(137.5));
  EXPECT_DOUBLE_EQ(robot.joints[1].limit_high, base::toRadians(135.0));
  EXPECT_EQ(robot.joints[2].homing, 0.562);
  EXPECT_EQ(homingOf(robot), Eigen::Vector3d(robot.joints[0].homing, robot.joints[1].homing, 0.562));
  EXPECT_EQ(robot.gravity, Eigen::Vector3d(-9.81, 0.0, 0.0));
  EXPECT_EQ(robot.marker, Eigen::Vector3d(0.0, 0.0, -0.47));
  EXPECT_EQ(robot.wrist.size(), 3U);
  EXPECT_EQ(robot.coupling[2][1], 0.008077387);
}

TEST(RobotFile, rightArmDiffersInItsRowsOnly) {
  Description right = testing::raven("right");
  const std::array alpha_deg = {180.0, 75.0, 52.0}, theta_deg = {25.0, 0.0, -90.0};
  Description left = testing::raven("left");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(right.joints[i].dh.alpha, base::toRadians(alpha_deg[i]));
    EXPECT_DOUBLE_EQ(right.joints[i].dh.theta, base::toRadians(theta_deg[i]));
    right.joints[i].dh = left.joints[i].dh;
  }
  right.name = left.name;
  EXPECT_EQ(formatDescription(right), formatDescription(left));
}

TEST(RobotFile, writtenAndReadAgainIsTheSame) {
  const std::string text = formatDescription(testing::raven());
  EXPECT_EQ(formatDescription(parseDescription(text, "again")), text);
}

TEST(RobotFile, numberOutOfRangeNamesFileLineKeyValueAndRange) {
  const std::string text = replaced(leftText(), "mass: 0.75 ", "mass: -0.75 ");
  const base::InputFault fault = faultOf(text);
  EXPECT_EQ(fault.file, "robot.yaml");
  EXPECT_EQ(fault.line, lineOf(text, "mass: -0.75"));
  EXPECT_EQ(fault.key, "joints[1].link.mass");
  EXPECT_EQ(fault.value, "-0.75");
  EXPECT_THAT(fault.reason + fault.remedy, HasSubstr("1000"));
}

TEST(RobotFile, unknownAndMissingKeysAreRefused) {
  EXPECT_EQ(faultOf(replaced(leftText(), "    max_speed:", "    top_speed:")).key, "joints[0].top_speed");
  const base::InputFault misspelt = faultOf(replaced(leftText(), "gravity: [", "gravty: ["));
  EXPECT_EQ(misspelt.key, "gravty");
  EXPECT_EQ(misspelt.remedy, "Did you mean gravity?");
  EXPECT_EQ(faultOf(replaced(leftText(), "gravity: [-9.81, 0.0, 0.0]", "")).key, "gravity");
}

TEST(RobotFile, jointTypeIsSpelled) {
  const base::InputFault fault = faultOf(replaced(leftText(), "type: prismatic", "type: sliding"));
  EXPECT_EQ(fault.key, "joints[2].type");
  EXPECT_EQ(fault.value, "sliding");
  EXPECT_THAT(fault.reason, HasSubstr("revolute, prismatic"));
}

TEST(RobotFile, oneDriveAJoint) {
  const std::string text = leftText();
  const std::size_t second = text.find("  - gear_ratio", text.find("  - gear_ratio") + 1);
  const std::size_t third = text.find("  - gear_ratio", second + 1);
  const base::InputFault fault = faultOf(text.substr(0, second) + text.substr(third));
  EXPECT_EQ(fault.key, "drives");
  EXPECT_THAT(fault.reason, HasSubstr("2 drives for 3 joints"));
  EXPECT_GT(fault.line, 0);
}

TEST(RobotFile, oneToSevenJoints) {
  Description robot = testing::raven();
  while (robot.joints.size() < 8) robot.joints.push_back(robot.joints[1]);
  EXPECT_THAT(faultOf(formatDescription(robot)).reason, HasSubstr("has 8 joints, allowed are 1 to 7"));
  robot.joints.clear();
  EXPECT_EQ(faultOf(formatDescription(robot)).key, "joints");
}

TEST(RobotFile, limitsAreOrdered) {
  const std::string text = replaced(leftText(), "limit_high: 0.56 ", "limit_high: 0.2 ");
  const base::InputFault fault = faultOf(text);
  EXPECT_EQ(fault.key, "joints[2].limit_high");
  EXPECT_EQ(fault.value, "0.2");
  EXPECT_EQ(fault.line, lineOf(text, "limit_high: 0.2 "));
  EXPECT_THAT(fault.reason, HasSubstr("limit_low = 0.23"));
}

TEST(RobotFile, hardStopIsNearTheLimits) {
  const base::InputFault fault = faultOf(replaced(leftText(), "homing: 0.562", "homing: 0.6"));
  EXPECT_EQ(fault.key, "joints[2].homing");
  EXPECT_THAT(fault.reason, HasSubstr("0.197 to 0.593"));
}

TEST(RobotFile, couplingIsSquareAndInvertible) {
  const base::InputFault ragged = faultOf(replaced(leftText(), "[0.14545, 1.0, 0.0]", "[0.14545, 1.0]"));
  EXPECT_EQ(ragged.key, "coupling[1]");
  EXPECT_THAT(ragged.reason, HasSubstr("2 numbers, the matrix is 3x3"));
  const base::InputFault few = faultOf(replaced(leftText(), "  - [0.14545, 1.0, 0.0]", "  #"));
  EXPECT_EQ(few.key, "coupling");
  EXPECT_THAT(few.reason, HasSubstr("2 rows for 3 joints"));
  const base::InputFault singular =
      faultOf(replaced(leftText(), "[0.14545, 1.0, 0.0]", "[0.14545, 0.0, 0.0]"));
  EXPECT_EQ(singular.key, "coupling");
  EXPECT_THAT(singular.reason, HasSubstr("cannot be inverted"));
}

TEST(RobotFile, absentFileIsNamed) {
  try {
    readDescription("no/such/robot.yaml");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "no/such/robot.yaml");
  }
}

}  // namespace
}  // namespace capstan::robot
