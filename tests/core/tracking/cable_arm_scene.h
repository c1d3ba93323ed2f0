#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "core/base/random.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_model.h"
#include "tests/support/folders.h"

namespace capstan::tracking {

inline const robot::Description& raven() {
  static const robot::Description robot =
      robot::readDescription(capstan::test::resourceFile("robots/raven2_left.yaml"));
  return robot;
}

namespace test {

/// Motor position and velocity that hold joints at q, moving at dq, with unstretched cables.
inline MotorState motorFor(const Eigen::Vector3d& q, const Eigen::Vector3d& dq) {
  static const CableArmConstants c = cableArmConstants(raven());
  MotorState motor;
  for (int i = 0; i < 3; ++i) {
    double travel = 0.0, speed = 0.0;
    for (int j = 0; j < 3; ++j) {
      travel += c.coupling[i][j] * (q(j) - c.homing[j]);
      speed += c.coupling[i][j] * dq(j);
    }
    motor.position(i) = c.link_radius[i] * travel / c.motor_scale[i];
    motor.velocity(i) = c.link_radius[i] * speed / c.motor_scale[i];
  }
  return motor;
}

/// A smooth motion through the middle of the workspace; `phase` makes runs differ.
inline MotorState motorAt(double t, double phase) {
  const Eigen::Vector3d centre(0.8, 1.6, 0.4), swing(0.3, 0.25, 0.05);
  Eigen::Vector3d q, dq;
  for (int i = 0; i < 3; ++i) {
    const double w = 2.0 + 0.7 * i;
    q(i) = centre(i) + swing(i) * std::sin(w * t + phase + i);
    dq(i) = swing(i) * w * std::cos(w * t + phase + i);
  }
  return motorFor(q, dq);
}

struct ArmMoment {
  CableArmModel::State x;
  MotorState begin, end;
};

/// A state inside the limits, its motors within a millimetre of unstretched cables.
inline ArmMoment randomMoment(base::Random& random) {
  ArmMoment now;
  Eigen::Vector3d q, dq;
  for (int i = 0; i < 3; ++i) {
    const robot::Joint& joint = raven().joints[static_cast<std::size_t>(i)];
    q(i) = random.uniform(joint.limit_low, joint.limit_high);
    dq(i) = random.normal(0.0, i < 2 ? 0.5 : 0.1);
    now.x(2 * i) = q(i);
    now.x(2 * i + 1) = dq(i);
  }
  now.begin = motorFor(q, dq);
  for (int i = 0; i < 3; ++i) now.begin.position(i) += random.normal(0.0, 1.0);
  now.end = now.begin;
  for (int i = 0; i < 3; ++i) {
    now.end.position(i) += random.normal(0.0, 0.1);
    now.end.velocity(i) += random.normal(0.0, 5.0);
  }
  return now;
}

}  // namespace test
}  // namespace capstan::tracking
