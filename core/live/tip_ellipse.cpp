#include "core/live/tip_ellipse.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace capstan::live {

std::optional<ImageEllipse> tipEllipse(const vision::Camera& camera,
                                       const Eigen::Isometry3d& camera_from_base,
                                       const Eigen::Vector3d& point, const Eigen::Matrix3d& covariance) {
  constexpr double kStep = 1e-5;  // of the central differences [m]
  constexpr double kSigmas = 2.0;
  const auto centre = camera.project(camera_from_base * point);
  if (!centre || !covariance.allFinite()) return std::nullopt;
  Eigen::Matrix<double, 2, 3> jacobian;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    const auto ahead = camera.project(camera_from_base * (point + step));
    const auto behind = camera.project(camera_from_base * (point - step));
    if (!ahead || !behind) return std::nullopt;
    jacobian.col(axis) = (*ahead - *behind) / (2.0 * kStep);
  }
  const Eigen::Matrix2d spread = jacobian * covariance * jacobian.transpose();
  if (!spread.allFinite() || !centre->allFinite()) return std::nullopt;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(spread);
  const auto half = [&](int i) { return kSigmas * std::sqrt(std::max(axes.eigenvalues()[i], 0.0)); };
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  return ImageEllipse{*centre, half(1), half(0), std::atan2(major.y(), major.x())};
}

}  // namespace capstan::live
