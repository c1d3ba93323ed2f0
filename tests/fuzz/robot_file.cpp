#include <cmath>

#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(robot_file) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const robot::Description robot = robot::parseDescription(std::string(bytes), "robot.yaml");
    fuzz::require(robot.size() >= 1 && robot.size() <= 7, "a robot has one to seven joints");
    for (const robot::Joint& joint : robot.joints)
      fuzz::require(joint.limit_high > joint.limit_low && std::isfinite(joint.homing), "limits are ordered");
    const std::string text = robot::formatDescription(robot);
    fuzz::require(robot::formatDescription(robot::parseDescription(text, "again.yaml")) == text,
                  "a robot is read as it was written");
  });
}
