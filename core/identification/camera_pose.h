#pragma once

#include <Eigen/Core>

#include "core/base/field.h"

namespace capstan::identification {

/// Errors of the recording's registration and clock. They are nuisance parameters of every identification,
/// because a camera rotated by half a degree has the same effect as a pulley radius that is wrong by 1 %. To
/// first order in small angles, the camera measures a true tip p [m, frame 0] at
///     p + shift + rotation × (p − centre),
/// with an exposure `delay` before the time stamp.
struct CameraPose {
  static constexpr int kSize = 7;
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rotation vector [rad], frame 0
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< translation of the centre [m], frame 0
  double delay = 0.0;                                  ///< delay of the time stamp [s]

  /// Measured position of the true position `tip` [m], frame 0.
  Eigen::Vector3d seen(const Eigen::Vector3d& tip, const Eigen::Vector3d& centre) const {
    return tip + shift + rotation.cross(tip - centre);
  }
};

/// Prior standard deviations of CameraPose about zero. Zero: the quantity is taken as exact.
struct CameraPoseOptions {
  double rotation_sigma = 0.0175;  ///< rotation about each axis [rad]; 1° suits a mount set up by hand
  double shift_sigma = 0.005;      ///< shift along each axis [m]
  double delay_sigma = 0.005;      ///< delay [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rotation_sigma,
          {"turn_sigma", "rad", "mounting error about each axis; 0: exact", {0.0, 1.0}, false});
    field(self.shift_sigma,
          {"shift_sigma", "m", "registration error along each axis; 0: exact", {0.0, 1.0}, false});
    field(self.delay_sigma, {"delay_sigma", "s", "error of the camera's clock; 0: exact", {0.0, 1.0}, false});
  }

  /// Standard deviations of rotation, shift and delay.
  Eigen::Matrix<double, CameraPose::kSize, 1> sigmas() const {
    Eigen::Matrix<double, CameraPose::kSize, 1> all;
    all << rotation_sigma, rotation_sigma, rotation_sigma, shift_sigma, shift_sigma, shift_sigma, delay_sigma;
    return all;
  }
};

/// Camera pose of the values of rotation, shift and delay.
inline CameraPose cameraPoseOf(const Eigen::Matrix<double, CameraPose::kSize, 1>& values) {
  return {values.head<3>(), values.segment<3>(3), values(6)};
}

}  // namespace capstan::identification
