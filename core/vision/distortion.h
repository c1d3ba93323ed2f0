#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>

namespace capstan::vision {

/// A point of the normalised image plane (x/z, y/z) and the Jacobian d distorted / d ideal there.
struct Distorted {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
};

/// Distorts an ideal point by OpenCV's plumb_bob model with the coefficients k1, k2, p1, p2, k3.
Distorted distort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& ideal);
/// Ideal point of a distorted one, by Newton steps until they are below 1e-13. `jacobian` is d distorted /
/// d ideal at the result.
Distorted undistort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& seen);

}  // namespace capstan::vision
