#pragma once

#include <Eigen/Geometry>

/// The tangent space of SO(3) (Solà, Deray and Atchuthan, A micro Lie theory for state estimation in
/// robotics, 2018, section IV).
namespace capstan::learning {

/// Rotation vector: axis times angle [rad], by the shorter rotation, so |result| ≤ π.
Eigen::Vector3d rotationVector(const Eigen::Quaterniond& rotation);

/// Rotation about the vector's direction by its length [rad].
Eigen::Quaterniond turnBy(const Eigen::Vector3d& rotation_vector);

}  // namespace capstan::learning
