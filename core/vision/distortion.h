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

/// OpenCV's plumb_bob model with coefficients k1, k2, p1, p2, k3: ideal to distorted.
Distorted distort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& ideal);
/// Distorted to ideal by Newton steps until they are below 1e-13; `jacobian` is d distorted / d ideal at the
/// answer.
Distorted undistort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& seen);

}  // namespace capstan::vision
