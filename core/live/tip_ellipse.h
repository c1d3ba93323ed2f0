#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/vision/camera.h"

namespace capstan::live {

/// An ellipse about a projected point.
struct ImageEllipse {
  Eigen::Vector2d centre;  ///< [px]
  double major, minor;     ///< half axes [px]
  double angle;            ///< of the major axis, from x to y [rad]
};

/// The 2 sigma ellipse of a point in an image: J P Jᵀ with the Jacobian J of the projection, lens distortion
/// included. `point` [m] and its covariance `covariance` [m²] are in a frame whose pose in the camera is
/// `camera_from_base`. For a normal distribution it holds the point with probability 1 − exp(−2) = 86 %.
/// Nothing if the point is not in front of the camera, or if a number is not finite.
std::optional<ImageEllipse> tipEllipse(const vision::Camera& camera,
                                       const Eigen::Isometry3d& camera_from_base,
                                       const Eigen::Vector3d& point, const Eigen::Matrix3d& covariance);

}  // namespace capstan::live
