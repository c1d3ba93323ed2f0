/// Recordings of real robots and of others' simulations, where they are on this machine.
#pragma once

#include "core/base/resource.h"
#include "core/robot/description.h"
#include "tests/support/folders.h"

namespace capstan::diagnosis {

using test::dataFolder;

inline robot::Description raven() {
  return robot::readDescription(base::resource("robots/raven2_left.yaml"));
}

inline robot::Description jaw() {
  return robot::readDescription(test::sourceFile("tests/core/identification/data/davinci_jaw.yaml"));
}

/// One sliding joint that a motor force drives.
inline robot::Description slide(double force_limit = 200.0) {
  robot::Description robot;
  robot.name = "slide";
  robot.joints.resize(1);
  robot.joints[0].type = robot::JointType::kPrismatic;
  robot.joints[0].limit_low = -0.3;
  robot.joints[0].limit_high = 0.3;
  robot.joints[0].max_speed = 1.0;
  robot.joints[0].link.mass = 95.0;
  robot.drives.resize(1);
  robot.drives[0].motor_capstan_radius = robot.drives[0].link_radius = 1.0;
  robot.drives[0].gear_ratio = 50.0;
  robot.drives[0].motor_torque_limit = force_limit;
  robot.coupling = {{1.0}};
  return robot;
}

}  // namespace capstan::diagnosis
