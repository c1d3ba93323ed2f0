#include "core/simulation/plant.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/math/rk4.h"
#include "core/simulation/truth_laws.h"

namespace capstan::simulation {
namespace {

const robot::Description& checked(const robot::Description& robot) {
  if (robot.drive == robot::DriveType::kCable) return robot;
  throw base::InputError({robot.name, 0, "drive", "rigid", "has no cables that could be simulated here",
                          "Give a robot file with drive: cable"});
}

/// True for an effect of the arm itself, false for one of its sensors.
bool isOfTheArm(const robot::Effect& effect) {
  constexpr std::string_view kSensors[] = {"camera_latency", "camera_rotation", "camera_offset",
                                           "camera_scale",   "encoder_slip",    "sensor_sign"};
  return std::ranges::find(kSensors, effect.effect) == std::end(kSensors);
}

}  // namespace

Plant::Plant(const robot::Description& nominal, const Truth& truth)
    : dynamics_(checked(nominal)), substep_(1e-3 / truth.substeps) {
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const robot::Drive& drive = nominal.drives[at];
    const JointTruth& joint = truth.joints[at];
    motor_friction_[at] = drive.motor_friction;
    link_friction_[at] = nominal.joints[at].friction;
    stribeck_[at] = joint.stribeck;
    hysteresis_[at] = joint.hysteresis;
    homing_[i] = nominal.joints[at].homing;
    motor_radius_[i] = drive.motor_capstan_radius / drive.gear_ratio;
    motor_inertia_[i] = drive.motor_inertia;
    torque_limit_[i] = drive.motor_torque_limit * joint.torque_limit_factor;
    stiffness_[i] = drive.cable_stiffness * joint.stiffness_factor;
    damping_[i] = drive.cable_damping * joint.damping_factor;
    exponent_[i] = drive.cable_exponent;
    for (int j = 0; j < 3; ++j)
      travel_by_joint_(i, j) =
          joint.link_radius.value_or(drive.link_radius) * nominal.coupling[at][static_cast<std::size_t>(j)];
  }
  if (std::ranges::any_of(nominal.effects, isOfTheArm)) {
    extended_.emplace(nominal, truth);
    constexpr double kShortest = 1e-6;  // shortest integration step [s]
    substep_ = std::max(std::min(substep_, 1.0 / robot::chainRate(extended_->model(), homing_)), kShortest);
  }
  reset(Eigen::Vector3d::Zero());
}

void Plant::reset(const Eigen::Vector3d& q_motor, double lead) {
  state_ = PlantState{};
  state_.t = -lead;
  state_.q_motor = q_motor;
  if (extended_)
    state_.q_link = extended_->jointsFromMotors(q_motor);
  else
    state_.q_link = homing_ + travel_by_joint_.inverse() * motor_radius_.cwiseProduct(q_motor);
}

double Plant::force(int joint, double stretch, double stretch_rate, double z) const {
  const double elastic = 2.0 * stiffness_[joint] * std::sinh(exponent_[joint] * stretch);
  const double branch = hysteresis_[static_cast<std::size_t>(joint)].stiffness;
  return elastic + 2.0 * damping_[joint] * stretch_rate + branch * z;
}

ExtendedArm::Vector Plant::extendedState() const {
  ExtendedArm::Vector x;
  x << state_.q_motor, state_.dq_motor, state_.q_link, state_.dq_link, state_.hysteresis, state_.loop,
      state_.creep;
  return x;
}

Eigen::Vector3d Plant::cableForce() const {
  if (extended_) return extended_->cableForce(state_.t, extendedState());
  const Eigen::Vector3d stretch =
      motor_radius_.cwiseProduct(state_.q_motor) - travel_by_joint_ * (state_.q_link - homing_);
  const Eigen::Vector3d rate =
      motor_radius_.cwiseProduct(state_.dq_motor) - travel_by_joint_ * state_.dq_link;
  Eigen::Vector3d gamma;
  for (int i = 0; i < 3; ++i) gamma[i] = force(i, stretch[i], rate[i], state_.hysteresis[i]);
  return gamma;
}

Plant::Vector Plant::derivative(const Vector& x, const Eigen::Vector3d& torque) const {
  const Eigen::Vector3d q_m = x.segment<3>(0), dq_m = x.segment<3>(3), q = x.segment<3>(6),
                        dq = x.segment<3>(9);
  const Eigen::Vector3d stretch = motor_radius_.cwiseProduct(q_m) - travel_by_joint_ * (q - homing_);
  const Eigen::Vector3d rate = motor_radius_.cwiseProduct(dq_m) - travel_by_joint_ * dq;

  Vector dx;
  Eigen::Vector3d gamma, friction;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    gamma[i] = force(i, stretch[i], rate[i], x[12 + i]);
    friction[i] = frictionForce(link_friction_[at], stribeck_[at], dq[i]);
    const double motor_loss = frictionForce(motor_friction_[at], Stribeck{}, dq_m[i]);
    dx[3 + i] = (torque[i] - motor_loss - motor_radius_[i] * gamma[i]) / motor_inertia_[i];  // (2)–(4)
    dx[12 + i] = hysteresisRate(hysteresis_[at], x[12 + i], rate[i]);
  }
  dx.segment<3>(0) = dq_m;
  dx.segment<3>(6) = dq;
  const Eigen::Vector3d joint_torque = travel_by_joint_.transpose() * gamma - friction;  // (7), (8)
  dx.segment<3>(9) = dynamics_.forward<double>(q, dq, joint_torque);
  return dx;
}

void Plant::step(const Eigen::Vector3d& torque, double dt) {
  const Eigen::Vector3d cut = torque.cwiseMax(-torque_limit_).cwiseMin(torque_limit_);
  const int steps = std::max(1, static_cast<int>(std::lround(dt / substep_)));
  const double h = dt / steps;
  if (extended_) {
    ExtendedArm::Vector x = extendedState();
    const auto motion = [&](double t, const ExtendedArm::Vector& at) {
      return extended_->derivative(t, at, cut);
    };
    for (int i = 0; i < steps; ++i) x = math::rk4Step(motion, state_.t + i * h, x, h);
    state_ = {x.segment<3>(0),  x.segment<3>(3),  x.segment<3>(6),  x.segment<3>(9),
              x.segment<3>(12), x.segment<3>(15), x.segment<3>(18), state_.t + dt};
    return;
  }
  Vector x;
  x << state_.q_motor, state_.dq_motor, state_.q_link, state_.dq_link, state_.hysteresis;
  const auto motion = [&](double, const Vector& at) { return derivative(at, cut); };
  for (int i = 0; i < steps; ++i) x = math::rk4Step(motion, 0.0, x, h);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  state_ = {x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9), x.segment<3>(12), none, none,
            state_.t + dt};
}

}  // namespace capstan::simulation
