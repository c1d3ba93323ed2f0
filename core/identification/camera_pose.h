#pragma once

#include <Eigen/Core>

#include "core/base/field.h"

namespace capstan::identification {

/// What is wrong with the recording's registration and clock: nuisance parameters of every identification,
/// for a camera rotated by half a degree looks like a pulley radius that is wrong by 1 %. To first order in
/// small angles, a true tip p [m, frame 0] is seen at
///     p + shift + rotation × (p − centre),
/// exposed `delay` before its stamp.
struct CameraPose {
  static constexpr int kSize = 7;
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< [rad], frame 0
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< of the centre [m], frame 0
  double delay = 0.0;                                  ///< [s]

  Eigen::Vector3d seen(const Eigen::Vector3d& tip, const Eigen::Vector3d& centre) const {
    return tip + shift + rotation.cross(tip - centre);
  }
};

/// How far registration and clock may be off: standard deviations of CameraPose about zero. Zero: taken as
/// exact.
struct CameraPoseOptions {
  double rotation_sigma = 0.0175;  ///< about each axis [rad]: a mount set up by hand
  double shift_sigma = 0.005;      ///< [m]
  double delay_sigma = 0.005;      ///< [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rotation_sigma,
          {"turn_sigma", "rad", "mounting error about each axis; 0: exact", {0.0, 1.0}, false});
    field(self.shift_sigma,
          {"shift_sigma", "m", "registration error along each axis; 0: exact", {0.0, 1.0}, false});
    field(self.delay_sigma, {"delay_sigma", "s", "error of the camera's clock; 0: exact", {0.0, 1.0}, false});
  }

  /// Of rotation, shift and delay.
  Eigen::Matrix<double, CameraPose::kSize, 1> sigmas() const {
    Eigen::Matrix<double, CameraPose::kSize, 1> all;
    all << rotation_sigma, rotation_sigma, rotation_sigma, shift_sigma, shift_sigma, shift_sigma, delay_sigma;
    return all;
  }
};

inline CameraPose cameraPoseOf(const Eigen::Matrix<double, CameraPose::kSize, 1>& values) {
  return {values.head<3>(), values.segment<3>(3), values(6)};
}

}  // namespace capstan::identification
