#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/robot/chain/chain_lanes.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_state.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot::testing {

/// randomRobot() with limits, friction, cables that carry it and a coupling.
inline Description drivenRobot(base::Random& random, int n, DriveType drive = DriveType::kCable) {
  Description robot = randomRobot(random, n);
  robot.drive = drive;
  for (int i = 0; i < n; ++i) {
    Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    joint.limit_low = random.uniform(-1.0, -0.5);
    joint.limit_high = random.uniform(0.5, 1.0);
    joint.homing = joint.limit_low;
    joint.max_speed = 3.0;
    joint.friction = {random.uniform(0.1, 0.5), random.uniform(0.1, 0.3), 0.05};
    Drive cable;
    cable.gear_ratio = random.uniform(10.0, 14.0);
    cable.motor_capstan_radius = 6e-3;
    cable.link_radius = random.uniform(0.05, 0.09);
    cable.cable_stiffness = random.uniform(1e3, 2e3);
    cable.cable_damping = random.uniform(40.0, 60.0);
    cable.cable_exponent = 100.0;
    cable.motor_inertia = 3e-5;
    cable.motor_friction = {0.01, 1e-4, 0.5};
    robot.drives.push_back(cable);
    std::vector<double> row(static_cast<std::size_t>(n), 0.0);
    for (int j = 0; j < i; ++j) row[static_cast<std::size_t>(j)] = random.uniform(-0.2, 0.2);
    row[static_cast<std::size_t>(i)] = 1.0;
    robot.coupling.push_back(row);
  }
  return robot;
}

inline Effect effectOf(const std::string& name, int joint, std::vector<EffectValue> values) {
  return {name, joint, std::move(values)};
}

/// Every law at joint `j` from 1, each clearly to be felt in a drivenRobot().
inline std::vector<Effect> everyLaw(int j, DriveType drive) {
  std::vector<Effect> effects = {
      effectOf("stribeck_friction", j, {{"excess", 0.8}, {"speed", 0.2}}),
      effectOf("asymmetric_friction", j, {{"share", 0.2}}),
      effectOf("load_friction", j, {{"share", 0.05}}),
      effectOf("position_friction", j, {{"sine", 0.3}, {"cosine", -0.2}, {"period", 0.4}}),
      effectOf("inertia", j, {{"added", 0.02}}),
      effectOf("viscous_friction", j, {{"added", 0.05}})};
  const std::vector<Effect> cable = {
      effectOf("capstan_eccentricity", j, {{"sine", 2e-4}, {"cosine", -3e-4}}),
      effectOf("encoder_slip", j, {{"slip", 0.5}, {"time", 0.3}}),
      effectOf("zero_drift", j, {{"drift", 0.02}, {"time_constant", 0.2}}),
      effectOf("cable_stiffening", j, {{"cubic", 2e4}}), effectOf("position_stiffness", j, {{"share", 0.3}}),
      effectOf("cable_hysteresis", j, {{"force", 20.0}, {"yield", 3e-4}}),
      effectOf("cable_creep", j, {{"share", 0.2}, {"time_constant", 0.3}}),
      effectOf("pulley_radius", j, {{"share", 0.03}}), effectOf("homing_offset", j, {{"offset", 0.02}}),
      // A joint has one of the two: slack takes the place of the play's press.
      j % 2 == 0 ? effectOf("backlash", j, {{"half_width", 2e-4}})
                 : effectOf("slack", j, {{"pretension", 3e-4}})};
  const std::vector<Effect> rigid = {effectOf("cable_compliance", j, {{"compliance", 3e-6 * j}}),
                                     effectOf("actuator_gain", j, {{"share", 0.1}}),
                                     effectOf("asymmetric_viscosity", j, {{"share", 0.3}}),
                                     effectOf("torque_offset", j, {{"offset", 0.2}})};
  const std::vector<Effect>& more = drive == DriveType::kCable ? cable : rigid;
  effects.insert(effects.end(), more.begin(), more.end());
  return effects;
}

inline Description withEveryLaw(Description robot) {
  for (int j = 1; j <= robot.size(); ++j)
    for (const Effect& effect : everyLaw(j, robot.drive)) robot.effects.push_back(effect);
  return robot;
}

/// A recording of what drives: from rest into sums of sines, a row each millisecond.
struct DrivenRows {
  std::vector<double> t;
  std::vector<std::vector<double>> drive, load;

  DrivenRows(const ChainModel& model, std::size_t rows) {
    const int n = model.shape.joints;
    drive.resize(static_cast<std::size_t>(n)), load = drive;
    for (std::size_t k = 0; k < rows; ++k) t.push_back(1e-3 * static_cast<double>(k));
    for (int j = 0; j < n; ++j)
      for (const double at : t) {
        const JointNumbers<double>& p = model.numbers.joints[j];
        const double begin = std::min(at / 0.2, 1.0), rise = begin * begin * (3.0 - 2.0 * begin);
        const double wave = rise * (std::sin((5.0 + j) * at) + 0.3 * std::sin(17.0 * at + j));
        const double travel = 0.7 + 0.3 * wave;  // [rad or m] of the joint, from the stop
        drive[static_cast<std::size_t>(j)].push_back(model.shape.rigid ? 2.0 * wave * p.lever / p.link_radius
                                                                       : travel * p.link_radius / p.lever);
        load[static_cast<std::size_t>(j)].push_back(0.5 * std::cos(11.0 * at));
      }
  }

  ChainRows view() const {
    ChainRows rows;
    rows.t = t.data();
    for (std::size_t j = 0; j < drive.size(); ++j)
      rows.drive[j] = drive[j].data(), rows.load[j] = load[j].data();
    return rows;
  }

  ChainInput at(const ChainShape& shape, std::size_t k) const {
    ChainInput input;
    input.t = t[k], input.dt = t[k + 1] - t[k];
    for (int j = 0; j < shape.joints; ++j) {
      const auto joint = static_cast<std::size_t>(j);
      if (shape.rigid) {
        input.torque[j] = drive[joint][k];
      } else {
        input.motor[j] = drive[joint][k], input.motor_end[j] = drive[joint][k + 1];
      }
      input.load[j] = input.signed_load[j] = load[joint][k];
    }
    return input;
  }

  /// Where the joints are at the first row, cables unstretched.
  JointVector start(const ChainModel& model) const {
    JointVector q_m(model.shape.joints);
    if (model.shape.rigid) return JointVector::Zero(model.shape.joints);
    for (int j = 0; j < model.shape.joints; ++j) q_m[j] = drive[static_cast<std::size_t>(j)][0];
    return jointsFromMotors(model, q_m);
  }
};

inline int stableSteps(const ChainModel& model, const JointVector& q) {
  return 1 + static_cast<int>(1e-3 * chainRate(model, q));
}

}  // namespace capstan::robot::testing
