#include "core/simulation/tool_arm.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simulation/encoder.h"
#include "core/simulation/quasi_static.h"

namespace capstan::simulation {
namespace {

using robot::JointVector;
using robot::kToolJoints;

constexpr int kRounds = 2000;          // most iterations over all joints per step
constexpr double kStandstill = 1e-11;  // largest change of a joint at convergence [rad or m]

}  // namespace

ToolArm::ToolArm(const robot::Description& nominal, const ToolTruth& truth)
    : truth_(truth),
      chain_(trueRobot(nominal, truth)),
      bodies_(trueRobot(nominal, truth)),
      transmission_(trueRobot(nominal, truth)),
      travel_(transmission_.linkRadius().asDiagonal() * transmission_.coupling()),
      stiffness_(JointVector::Zero(kToolJoints)) {
  for (int i = 0; i < kToolJoints; ++i) {
    const robot::Drive& drive = nominal.drives[static_cast<std::size_t>(i)];
    motors_[static_cast<std::size_t>(i)] = {
        drive.motor_capstan_radius / drive.gear_ratio, 1.0 / drive.gear_ratio, drive.motor_friction.coulomb,
        drive.motor_friction.viscous, 2.0 * std::numbers::pi / drive.encoder_counts};
    for (int cable = 0; cable < kToolJoints; ++cable)
      stiffness_[i] += this->truth(cable).stiffness * travel_(cable, i) * travel_(cable, i);
  }
  reset(JointVector::Zero(kToolJoints));
}

double ToolArm::motorTravel(int i, double angle) const {
  const MotorNumbers& motor = motors_[static_cast<std::size_t>(i)];
  const ToolJointTruth& joint = truth(i);
  const double phase = joint.eccentric_phase;
  return motor.lever * angle +
         joint.eccentricity * (std::sin(angle * motor.inverse_gear + phase) - std::sin(phase));
}

double ToolArm::cableForce(int i) const {
  return forceBeyondPlay(delta_[i], truth(i).play, truth(i).stiffness);
}

JointVector ToolArm::cableForce() const {
  JointVector force(kToolJoints);
  for (int i = 0; i < kToolJoints; ++i) force[i] = cableForce(i);
  return force;
}

void ToolArm::reset(const JointVector& q_motor) {
  q_motor_ = q_motor;
  JointVector travel(kToolJoints);
  for (int i = 0; i < kToolJoints; ++i) travel[i] = motorTravel(i, q_motor[i]);
  q_ = transmission_.homing() + travel_.partialPivLu().solve(travel);
  begin_ = q_;
  speed_ = delta_ = JointVector::Zero(kToolJoints);
  gravity_ = bodies_.bias(q_, speed_);
}

void ToolArm::moveMotors(const JointVector& target, const JointVector& target_rate, double dt) {
  for (int i = 0; i < kToolJoints; ++i) {
    const MotorNumbers& motor = motors_[static_cast<std::size_t>(i)];
    const ToolControlTruth& control = truth_.control;
    const double net = control.stiffness * (target[i] - q_motor_[i]) + control.damping * target_rate[i] -
                       motor.lever * cableForce(i);
    const double before = motorTravel(i, q_motor_[i]);
    q_motor_[i] += moved(net, motor.coulomb, control.stiffness, control.damping + motor.viscous, dt);
    delta_[i] += motorTravel(i, q_motor_[i]) - before;
  }
}

/// Moves joint i to its equilibrium with all other joints fixed. Returns the distance [rad or m].
double ToolArm::moveJoint(int i, double dt) {
  const ToolJointTruth& joint = truth(i);
  double torque = 0.0;
  for (int cable = 0; cable < kToolJoints; ++cable) torque += travel_(cable, i) * cableForce(cable);
  const double dry = breakaway(joint.coulomb, joint.stribeck_excess, joint.stribeck_speed, speed_[i]) +
                     joint.load_friction * std::abs(torque);
  const double net = torque - gravity_[i] + stiffness_[i] * (q_[i] - begin_[i]);
  const double change = begin_[i] + moved(net, dry, stiffness_[i], joint.viscous, dt) - q_[i];
  q_[i] += change;
  for (int cable = 0; cable < kToolJoints; ++cable) delta_[cable] -= travel_(cable, i) * change;
  return std::abs(change);
}

void ToolArm::step(const JointVector& target, const JointVector& target_rate, double dt) {
  begin_ = q_;
  moveMotors(target, target_rate, dt);
  for (int round = 0; round < kRounds; ++round) {
    double farthest = 0.0;
    for (int i = 0; i < kToolJoints; ++i) farthest = std::max(farthest, moveJoint(i, dt));
    if (farthest < kStandstill) break;
  }
  speed_ = (q_ - begin_) / dt;
  gravity_ = bodies_.bias(q_, JointVector::Zero(kToolJoints));
}

JointVector ToolArm::encoders() const {
  JointVector counted(kToolJoints);
  for (int i = 0; i < kToolJoints; ++i)
    counted[i] = quantised(q_motor_[i], motors_[static_cast<std::size_t>(i)].count);
  return counted;
}

Eigen::Isometry3d ToolArm::pose() const {
  return chain_.linkPose(kToolJoints - 1, q_) *
         Eigen::AngleAxisd(0.5 * q_[kToolJoints - 1], Eigen::Vector3d::UnitZ());
}

}  // namespace capstan::simulation
