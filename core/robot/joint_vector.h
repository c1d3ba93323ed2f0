#pragma once

#include <Eigen/Core>

namespace capstan::robot {

inline constexpr int kMaxJoints = 7;

/// Vector with one number per joint, base first. Up to seven numbers without the heap; converts to and from
/// Eigen::Vector3d.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;
/// Matrix n×n over the joints, up to 7×7 without the heap.
using JointMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxJoints>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

}  // namespace capstan::robot
