#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "core/learning/poses/states.h"

/// Errors of corrected poses relative to commanded poses.
namespace capstan::learning {

/// Summary of the errors of many states.
struct CorrectionErrors {
  /// Mean of |x|, |y|, |z| [m], |yaw|, |pitch|, |roll| [rad].
  learning::Vector6d mean = learning::Vector6d::Zero();
  learning::Vector6d deviation = learning::Vector6d::Zero(), median = learning::Vector6d::Zero();
  double distance = 0.0, median_distance = 0.0;  ///< mean and median of ‖Δt‖ [m]
  double angle = 0.0, median_angle = 0.0;        ///< mean and median of the geodesic angle [rad]
  std::size_t states = 0;
};

/// Errors per state. Translation errors are along the axes. Rotation errors are differences of the yaw, pitch
/// and roll of the corrected and of the commanded rotation. Both rotations are taken relative to `middle`, to
/// stay away from a pitch of 90°, where yaw and roll cannot be distinguished.
struct PoseErrors {
  Eigen::Quaterniond middle = Eigen::Quaterniond::Identity();
  std::vector<learning::Vector6d> apart;  ///< |x|, |y|, |z| [m], |yaw|, |pitch|, |roll| [rad]
  std::vector<double> distance, angle;    ///< ‖Δt‖ [m], the geodesic angle [rad]

  void add(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& commanded);
  void add(const PoseErrors& other);
  /// Errors of all states in one degree of freedom, 0…5.
  std::vector<double> along(Eigen::Index degree) const;
  CorrectionErrors summed() const;
};

/// Mean of the commanded rotations, for PoseErrors::middle.
Eigen::Quaterniond middleCommandOf(const std::vector<learning::State>& states);

/// Names of the degrees of freedom, three of position and three of rotation.
inline constexpr std::array kDegreesOfFreedom = {"x", "y", "z", "yaw", "pitch", "roll"};

}  // namespace capstan::learning
