#pragma once

#include <Eigen/Core>

namespace capstan::tracking {

/// What the transmission makes of a motor's position, as against the robot file:
///     q_m' = (1 + scale) q_m + offset,   dq_m' = (1 + scale) dq_m.
/// `scale` is dimensionless, r_l,nominal / r_l − 1 of a pulley whose radius is wrong; `offset` in rad of the
/// motor, e.g. of a homing that was off.
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
