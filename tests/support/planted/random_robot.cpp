#include "tests/support/planted/random_robot.h"

#include <cmath>
#include <numbers>

#include "tests/support/planted/log_uniform.h"
#include "tests/support/planted/rigid_chain.h"

namespace capstan::test {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

bool oneIn(base::Random& random, double times) { return random.uniform(0.0, times) < 1.0; }

robot::DhRow row(int joint, base::Random& random) {
  constexpr std::array kTwists = {90.0, -90.0, 75.0, -60.0, 128.0, 0.0};  // [deg]
  robot::DhRow dh;
  if (joint == 0) return dh;
  dh.alpha = kTwists[random.bits() % kTwists.size()] * kPi / 180.0;
  // Parallel axes need a distance: else two joints would turn about one line.
  if (dh.alpha == 0.0 || oneIn(random, 1.7)) dh.a = random.uniform(0.08, 0.25);
  return dh;
}

robot::Link link(double mass, base::Random& random) {
  robot::Link link;
  link.mass = mass;
  for (int k = 0; k < 3; ++k) {
    link.centre_of_mass[k] = random.uniform(-0.15, 0.15);
    link.inertia[k] = mass * 0.08 * 0.08 * random.uniform(0.8, 1.2);
  }
  return link;
}

void setRange(robot::Joint& joint, base::Random& random) {
  const bool turns = joint.type == robot::JointType::kRevolute;
  const double range = turns ? random.uniform(1.0, 2.0) : random.uniform(0.15, 0.3);
  const double low = turns ? random.uniform(-1.5, 0.5) : random.uniform(0.05, 0.2);
  joint.limit_low = low;
  joint.limit_high = low + range;
  joint.homing = oneIn(random, 2.0) ? low - 0.01 * range : low + 1.01 * range;
  joint.max_speed = turns ? random.uniform(0.8, 2.0) : random.uniform(0.05, 0.12);
}

/// Inertia of each joint in the middle of its range [kg·m² or kg].
Joints inertiaOf(const robot::Description& robot) {
  RigidChain chain(robot);
  Joints middle{};
  for (std::size_t i = 0; i < robot.joints.size(); ++i)
    middle[i] = 0.5 * (robot.joints[i].limit_low + robot.joints[i].limit_high);
  chain.pose(middle);
  const RigidChain::Matrix mass = chain.massMatrix();
  Joints inertia{};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) inertia[i] = mass[i][i];
  return inertia;
}

robot::Drive cableDrive(const robot::Joint& joint, double inertia, base::Random& random) {
  const bool turns = joint.type == robot::JointType::kRevolute;
  robot::Drive drive;
  drive.gear_ratio = random.uniform(8.0, 16.0);
  drive.motor_capstan_radius = random.uniform(4e-3, 8e-3);
  drive.link_radius = turns ? random.uniform(0.035, 0.07) : 1.0;
  const double stretch = turns ? logUniform(random, 3e-4, 3e-3) : logUniform(random, 3e-5, 3e-4);
  const double stiffness = joint.friction.coulomb / stretch;  // at the joint
  const double damping = random.uniform(0.2, 1.0) * 2.0 * std::sqrt(stiffness * inertia);
  const double square = drive.link_radius * drive.link_radius;
  drive.cable_exponent = 1.0;
  drive.cable_stiffness = stiffness / (2.0 * square);
  drive.cable_damping = damping / (2.0 * square);
  drive.motor_inertia = random.uniform(1.5e-4, 4e-4);
  drive.motor_friction.coulomb = random.uniform(0.03, 0.09);
  drive.motor_friction.viscous = random.uniform(1e-3, 3e-3);
  drive.motor_friction.smoothing = 0.5;
  drive.motor_torque_limit = 3.0;
  drive.encoder_counts = 4000.0;
  return drive;
}

robot::Drive directDrive() {
  robot::Drive drive;
  drive.gear_ratio = drive.motor_capstan_radius = drive.link_radius = drive.cable_exponent = 1.0;
  drive.cable_stiffness = 1e6;
  drive.motor_inertia = 5e-3;
  drive.motor_friction.smoothing = 0.01;
  drive.motor_torque_limit = 200.0;
  drive.encoder_counts = 200000.0;
  return drive;
}

void setCoupling(robot::Description& robot, base::Random& random) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    robot.coupling.emplace_back(robot.joints.size(), 0.0);
    robot.coupling[i][i] = 1.0;
    const bool turns = robot.joints[i].type == robot::JointType::kRevolute;
    for (std::size_t j = 0; j < i; ++j) {
      const double amount = random.uniform(-0.3, 0.3) * (turns ? 1.0 : 0.05);
      if (robot.drive == robot::DriveType::kCable && oneIn(random, 2.5) &&
          robot.joints[j].type == robot::JointType::kRevolute)
        robot.coupling[i][j] = amount;
    }
  }
}

robot::Description randomRobot(int joints, robot::DriveType drive, base::Random& random) {
  const bool cable = drive == robot::DriveType::kCable;
  robot::Description robot;
  robot.name = "random robot";
  robot.drive = drive;
  robot.gravity = oneIn(random, 2.0) ? Vector3d(0.0, 0.0, -9.81) : Vector3d(-9.81, 0.0, 0.0);
  double mass = cable ? random.uniform(0.4, 1.0) : random.uniform(2.0, 5.0);
  for (int i = 0; i < joints; ++i) {
    robot::Joint joint;
    joint.name = "joint " + std::to_string(i + 1);
    joint.type = cable && oneIn(random, 5.0) ? robot::JointType::kPrismatic : robot::JointType::kRevolute;
    const bool turns = joint.type == robot::JointType::kRevolute;
    joint.dh = row(i, random);
    joint.link = link(mass, random);
    setRange(joint, random);
    joint.friction.coulomb =
        mass * (cable ? random.uniform(0.4, 1.2) : random.uniform(0.07, 0.2)) * (turns ? 1.0 : 3.0);
    joint.friction.viscous = (cable ? 0.01 : 3.0) * joint.friction.coulomb * random.uniform(0.5, 1.5);
    joint.friction.smoothing = cable ? (turns ? 5e-3 : 2e-3) : 0.02;
    robot.joints.push_back(joint);
    mass *= random.uniform(0.45, 0.8);
  }
  const Joints inertia = inertiaOf(robot);
  for (std::size_t i = 0; i < robot.joints.size(); ++i)
    robot.drives.push_back(cable ? cableDrive(robot.joints[i], inertia[i], random) : directDrive());
  setCoupling(robot, random);
  robot.marker = Vector3d(random.uniform(0.08, 0.25), random.uniform(-0.05, 0.05), random.uniform(-0.2, 0.2));
  robot.marker_radius = 7e-3;
  return robot::parseDescription(robot::formatDescription(robot), "random robot");
}

}  // namespace

robot::Description randomCableRobot(int joints, base::Random& random) {
  return randomRobot(joints, robot::DriveType::kCable, random);
}

robot::Description randomRigidRobot(int joints, base::Random& random) {
  return randomRobot(joints, robot::DriveType::kRigid, random);
}

}  // namespace capstan::test
