#pragma once

#include <Eigen/Core>

#include "core/vision/camera.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Line of sight of one camera of a rig through a marker's centre. Frame: the left camera's.
struct CameraRay {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< centre of the camera [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector
  double sigma = 0.0;                                    ///< standard deviation of the direction [rad]

  /// Point of the ray nearest to `point` [m].
  Eigen::Vector3d nearest(const Eigen::Vector3d& point) const {
    return origin + direction * direction.dot(point - origin);
  }
  /// Covariance of a point of the ray at the distance of `point` [m²]: none along the ray.
  Eigen::Matrix3d covariance(const Eigen::Vector3d& point) const {
    const double across = sigma * (point - origin).norm();
    return across * across * (Eigen::Matrix3d::Identity() - direction * direction.transpose());
  }
};

/// Ray of the camera `side` (0 left, 1 right) through a marker that was found.
CameraRay rayThrough(const StereoRig& rig, int side, const MarkerDetection& marker);

}  // namespace capstan::vision
