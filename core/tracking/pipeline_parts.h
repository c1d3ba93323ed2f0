#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>

#include "core/estimation/square_root_ukf.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/motor_reading.h"
#include "core/tracking/options.h"

/// Small parts of the tracking pipeline.
namespace capstan::tracking {

inline constexpr double kMotorRate = 1000.0;  // [1/s], determines the size of the memory

inline CableArmModel modelOf(const robot::Description& robot, const TrackingOptions& options) {
  CableArmModel model(MotorReading::undone(robot));
  model.setUnknownMotion({options.unknown_speed, options.unknown_speed_time});
  return model;
}

inline estimation::Lower<6> diagonalOf(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
  estimation::Lower<6> root = estimation::Lower<6>::Zero();
  for (int joint = 0; joint < 3; ++joint) {
    root(2 * joint, 2 * joint) = position(joint);
    root(2 * joint + 1, 2 * joint + 1) = velocity(joint);
  }
  return root;
}

inline estimation::Lower<3> rootOf(const Eigen::Matrix3d& covariance) {
  return estimation::Lower<3>(covariance.llt().matrixL());
}

inline std::size_t memorySize(const TrackingOptions& options) {
  return static_cast<std::size_t>(std::ceil(1.25 * kMotorRate * options.memory)) + 64;
}

}  // namespace capstan::tracking
