#include "core/simulation/extended_arm.h"

#include "core/robot/chain/chain_bodies.h"
#include "core/robot/chain/chain_law.h"
#include "core/robot/chain/chain_state.h"
#include "core/simulation/truth_laws.h"

namespace capstan::simulation {
namespace {

using Eigen::Vector3d;

/// The robot with the parameters of the truth, before effects act.
robot::Description worn(robot::Description robot, const Truth& truth) {
  for (std::size_t i = 0; i < robot.drives.size() && i < truth.joints.size(); ++i) {
    robot::Drive& drive = robot.drives[i];
    const JointTruth& joint = truth.joints[i];
    drive.link_radius = joint.link_radius.value_or(drive.link_radius);
    drive.cable_stiffness *= joint.stiffness_factor;
    drive.cable_damping *= joint.damping_factor;
  }
  return robot;
}

}  // namespace

ExtendedArm::ExtendedArm(const robot::Description& robot, const Truth& truth) : model_(worn(robot, truth)) {
  for (std::size_t i = 0; i < 3; ++i) {
    stribeck_[i] = truth.joints[i].stribeck;
    hysteresis_[i] = truth.joints[i].hysteresis;
  }
}

ExtendedArm::Cables ExtendedArm::cablesOf(double t, const Vector& x) const {
  const robot::ChainNumbers<double>& p = model_.numbers;
  Cables cables;
  for (int i = 0; i < 3; ++i) {
    const robot::JointNumbers<double>& joint = p.joints[i];
    const unsigned laws = model_.shape.laws[i];
    const robot::ZeroShift<double> zero = robot::zeroShiftAt(joint, t);
    double travel = -p.coupling[i][i] * zero.by, speed = -p.coupling[i][i] * zero.rate;
    for (int j = 0; j < 3; ++j) {
      travel += p.coupling[i][j] * (x[6 + j] - p.joints[j].homing);
      speed += p.coupling[i][j] * x[9 + j];
    }
    const double lever = robot::motorLever(joint, laws, x[i]);
    const double stretch = robot::motorTravel(joint, laws, x[i]) - joint.link_radius * travel;
    const double rate = lever * x[3 + i] - joint.link_radius * speed;
    const double range = (x[6 + i] - model_.shape.middle[i]) * model_.shape.inverse_half_range[i];
    const robot::CablePull<double> pull =
        robot::cablePull(joint, laws, stretch, rate, range, x[15 + i], x[18 + i]);
    const Hysteresis& loop = hysteresis_[static_cast<std::size_t>(i)];
    cables.force[i] = pull.force + loop.stiffness * x[12 + i];
    cables.lever[i] = lever;
    cables.rate[i] = rate;
    cables.loop_rate[i] = laws & robot::kLawHysteresis ? pull.hysteresis_rate : 0.0;
    cables.creep_rate[i] = laws & robot::kLawCreep ? pull.creep_rate : 0.0;
  }
  return cables;
}

double ExtendedArm::friction(int joint, const Vector& x, double drive) const {
  const robot::JointNumbers<double>& p = model_.numbers.joints[joint];
  const double force =
      robot::jointFriction(p, model_.shape.laws[joint], x[6 + joint], x[9 + joint], drive).force;
  const Stribeck& excess = stribeck_[static_cast<std::size_t>(joint)];
  if (excess.excess <= 0.0) return force;
  const robot::Friction coulomb{p.coulomb, 0.0, 1.0 / p.inverse_smoothing};
  return force + frictionForce(coulomb, excess, x[9 + joint]) - frictionForce(coulomb, {}, x[9 + joint]);
}

ExtendedArm::Vector ExtendedArm::derivative(double t, const Vector& x, const Vector3d& torque) const {
  const robot::ChainNumbers<double>& p = model_.numbers;
  const Cables cables = cablesOf(t, x);
  robot::ChainBodies<double> bodies;
  robot::chainBodies<double>(model_.shape, p, x.data() + 6, x.data() + 9, bodies);
  double acceleration[robot::kChainJoints];
  for (int j = 0; j < 3; ++j) {
    double drive = 0.0;
    for (int i = 0; i < 3; ++i) drive += p.coupling[i][j] * p.joints[i].link_radius * cables.force[i];
    acceleration[j] = drive - bodies.bias[j] - friction(j, x, drive);
    bodies.mass[j][j] += p.joints[j].armature;
  }
  robot::factorise<double>(3, bodies.mass);
  robot::solve<double>(3, bodies.mass, acceleration);
  Vector dx;
  for (int i = 0; i < 3; ++i) {
    const robot::JointNumbers<double>& joint = p.joints[i];
    dx[i] = x[3 + i];
    dx[3 + i] =
        (torque[i] - robot::motorFriction(joint, x[3 + i]).force - cables.lever[i] * cables.force[i]) /
        joint.motor_inertia;
    dx[6 + i] = x[9 + i];
    dx[9 + i] = acceleration[i];
    dx[12 + i] = hysteresisRate(hysteresis_[static_cast<std::size_t>(i)], x[12 + i], cables.rate[i]);
    dx[15 + i] = cables.loop_rate[i];
    dx[18 + i] = cables.creep_rate[i];
  }
  return dx;
}

Vector3d ExtendedArm::cableForce(double t, const Vector& x) const { return cablesOf(t, x).force; }

Vector3d ExtendedArm::jointsFromMotors(const Vector3d& q_motor) const {
  return robot::jointsFromMotors(model_, q_motor);
}

}  // namespace capstan::simulation
