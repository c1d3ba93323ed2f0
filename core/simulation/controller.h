#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/robot/description.h"
#include "core/robot/transmission.h"
#include "core/simulation/encoder.h"
#include "core/simulation/trajectory.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// The robot's own 1 kHz controller: PD control of the motor angles (equation: ControllerTruth in truth.h).
/// The nominal transmission gives desired motor angles from desired joints: the robot does not know the true
/// one.
class MotorController {
 public:
  MotorController(const robot::Description& nominal, const ControllerTruth& gains)
      : transmission_(nominal), gains_(gains) {
    for (int i = 0; i < 3; ++i) {
      const robot::Drive& drive = nominal.drives[static_cast<std::size_t>(i)];
      coulomb_[i] = drive.motor_friction.coulomb;
      smoothing_[i] = drive.motor_friction.smoothing;
      limit_[i] = drive.motor_torque_limit;
    }
  }

  /// Motor angles [rad] of joints `q` [rad, rad, m] by the nominal transmission.
  Eigen::Vector3d motorsFor(const Eigen::Vector3d& q) const { return transmission_.motorFromJoint(q); }

  /// Commanded motor torque tau [N·m], limited to the nominal torque limits.
  Eigen::Vector3d torque(const JointTarget& target, const MotorEncoders& encoders) const {
    const Eigen::Vector3d q_md = transmission_.motorFromJoint(target.position);
    const Eigen::Vector3d dq_md = transmission_.motorVelocityFromJoint(target.velocity);
    Eigen::Vector3d tau =
        gains_.stiffness * (q_md - encoders.position()) + gains_.damping * (dq_md - encoders.velocity());
    for (int i = 0; i < 3; ++i)
      tau[i] += gains_.friction_feedforward * coulomb_[i] * std::tanh(dq_md[i] / smoothing_[i]);
    return tau.cwiseMax(-limit_).cwiseMin(limit_);
  }

 private:
  robot::Transmission transmission_;
  ControllerTruth gains_;
  Eigen::Vector3d coulomb_, smoothing_, limit_;
};

}  // namespace capstan::simulation
