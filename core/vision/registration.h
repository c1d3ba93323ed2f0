#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <span>

#include "core/base/names.h"
#include "core/base/result.h"

namespace capstan::vision {

/// Reason why the points do not determine a transform.
enum class RegistrationFault { kTooFewPoints, kUnequalCounts, kNotFinite, kCollinear };

struct Registration {
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();  ///< standard deviation of the translation, base axes [m]
  Eigen::Vector3d sigma_rotation =
      Eigen::Vector3d::Zero();  ///< standard deviation about base axes [rad]; zero for a given rotation
  double rms = 0.0;             ///< RMS distance of the points from their expected positions [m]
  int frames = 0;               ///< number of points used
};

/// Computes base_from_camera by the UKF paper's (1) from triangulated positions of the marker at the hard
/// stop [m, camera frame], the known rotation `base_R_camera` and the known position of the marker at the
/// hard stop [m, base frame]. The positions are averaged; sigma is the standard deviation of their mean. At
/// least two points.
base::Result<Registration, RegistrationFault> registerAtHardStop(
    std::span<const Eigen::Vector3d> points_camera, const Eigen::Matrix3d& base_R_camera,
    const Eigen::Vector3d& marker_in_base);

/// Computes the whole rigid transform by least squares (Kabsch 1976) from the same points in both frames [m],
/// in several poses or of several markers. At least three points that are not on one line. sigma comes from
/// the residuals with 3 n − 6 degrees of freedom.
base::Result<Registration, RegistrationFault> registerRigid(std::span<const Eigen::Vector3d> points_camera,
                                                            std::span<const Eigen::Vector3d> points_base);

}  // namespace capstan::vision

template <>
struct capstan::base::NamesOf<capstan::vision::RegistrationFault> {
  using F = capstan::vision::RegistrationFault;
  static constexpr std::array value = {
      std::pair{F::kTooFewPoints, "too few points"},
      std::pair{F::kUnequalCounts, "unequal numbers of points in the two frames"},
      std::pair{F::kNotFinite, "a coordinate is not finite"},
      std::pair{F::kCollinear, "points lie on one line"}};
};
