#pragma once

#include <Eigen/Core>

namespace capstan::tracking {

/// Correction of motor positions and velocities for errors of the transmission's constants in the robot file:
///     q_m' = (1 + scale) q_m + offset,   dq_m' = (1 + scale) dq_m.
/// `scale` is dimensionless: r_l,nominal / r_l − 1 for a wrong pulley radius. `offset` is a motor angle
/// [rad], for example from a wrong homing.
struct MotorCorrection {
  Eigen::Vector3d scale = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  Eigen::Vector3d position(const Eigen::Vector3d& motor) const {
    return motor + scale.cwiseProduct(motor) + offset;
  }
  Eigen::Vector3d velocity(const Eigen::Vector3d& motor) const { return motor + scale.cwiseProduct(motor); }
  bool operator==(const MotorCorrection&) const = default;
};

}  // namespace capstan::tracking
