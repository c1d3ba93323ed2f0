#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "core/base/random.h"
#include "core/robot/description.h"
#include "tests/support/folders.h"

namespace capstan::robot::testing {

inline std::filesystem::path robotFile(const std::string& side) {
  return capstan::test::resourceFile("robots/raven2_" + side + ".yaml");
}

inline Description raven(const std::string& side = "left") { return readDescription(robotFile(side)); }

inline Eigen::Vector3d randomVector(base::Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A position inside the limits, first three joints.
inline Eigen::Vector3d randomInside(base::Random& random, const Description& robot) {
  Eigen::Vector3d q;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    q[i] = random.uniform(joint.limit_low, joint.limit_high);
  }
  return q;
}

/// A robot of `n` joints of either kind with random geometry and bodies; gravity along no axis.
inline Description randomRobot(base::Random& random, int n) {
  Description robot;
  robot.name = "random";
  robot.gravity = {1.0, -2.0, -9.0};
  robot.marker = randomVector(random, 0.5);
  for (int i = 0; i < n; ++i) {
    Joint joint;
    joint.type = random.uniform(0.0, 1.0) < 0.6 ? JointType::kRevolute : JointType::kPrismatic;
    joint.dh = {random.uniform(-3.0, 3.0), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                random.uniform(-3.0, 3.0)};
    joint.link.mass = random.uniform(0.2, 2.0);
    joint.link.centre_of_mass = randomVector(random, 0.3);
    joint.link.inertia = {random.uniform(2e-3, 4e-3), random.uniform(2e-3, 4e-3), random.uniform(2e-3, 4e-3)};
    robot.joints.push_back(joint);
  }
  return robot;
}

}  // namespace capstan::robot::testing
