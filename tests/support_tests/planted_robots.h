#pragma once

#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::test {

inline robot::Description raven() { return robot::readDescription(resourceFile("robots/raven2_left.yaml")); }

inline robot::Description rigidRobot(const std::string& name) {
  return robot::readDescription(sourceFile("tests/support/planted/data/" + name + ".yaml"));
}

/// One level sliding joint of 2 kg on a cable of 1e4 N/m (2 k a), viscous enough to come to rest soon; no dry
/// friction but a trace that sets the scale of its effects.
inline robot::Description slider() {
  robot::Description robot;
  robot.name = "slider";
  robot::Joint joint;
  joint.name = "slider";
  joint.type = robot::JointType::kPrismatic;
  joint.limit_low = -0.5;
  joint.limit_high = 0.5;
  joint.max_speed = 1.0;
  joint.link.mass = 2.0;
  joint.link.inertia = {0.1, 0.1, 0.1};
  joint.friction = {0.0, 300.0, 0.01};
  robot::Drive drive;
  drive.gear_ratio = 10.0;
  drive.motor_capstan_radius = 0.01;
  drive.link_radius = 1.0;
  drive.cable_stiffness = 5e3;
  drive.cable_damping = 20.0;
  drive.cable_exponent = 1.0;
  drive.motor_inertia = 1e-4;
  drive.motor_friction = {0.0, 1e-3, 0.5};
  drive.motor_torque_limit = 10.0;
  robot.joints = {joint};
  robot.drives = {drive};
  robot.coupling = {{1.0}};
  return robot;
}

inline DrawOptions optionsFor(const robot::Description& robot, bool rigid) {
  DrawOptions options;
  options.robot = robot;
  options.rigid = rigid;
  return options;
}

}  // namespace capstan::test
