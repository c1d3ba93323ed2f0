#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "core/learning/poses/states.h"

/// Errors of corrected poses against commanded ones.
namespace capstan::learning {

/// Errors of many states, summed up.
struct CorrectionErrors {
  learning::Vector6d mean =
      learning::Vector6d::Zero();  ///< of |x|, |y|, |z| [m], |yaw|, |pitch|, |roll| [rad]
  learning::Vector6d deviation = learning::Vector6d::Zero(), median = learning::Vector6d::Zero();
  double distance = 0.0, median_distance = 0.0;  ///< mean and median of ‖Δt‖ [m]
  double angle = 0.0, median_angle = 0.0;        ///< mean and median of the geodesic angle [rad]
  std::size_t states = 0;
};

/// Errors state by state, before they are summed up: translations along the axes, angles as yaw, pitch and
/// roll of either turn apart, each counted from `middle` so that none comes near a pitch of 90°, where yaw
/// and roll are hardly two.
struct PoseErrors {
  Eigen::Quaterniond middle = Eigen::Quaterniond::Identity();
  std::vector<learning::Vector6d> apart;  ///< |x|, |y|, |z| [m], |yaw|, |pitch|, |roll| [rad]
  std::vector<double> distance, angle;    ///< ‖Δt‖ [m], the geodesic angle [rad]

  void add(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& commanded);
  void add(const PoseErrors& other);
  /// Of one degree of freedom, 0…5.
  std::vector<double> along(Eigen::Index degree) const;
  CorrectionErrors summed() const;
};

/// Mean of the commanded rotations, for PoseErrors.
Eigen::Quaterniond middleCommandOf(const std::vector<learning::State>& states);

/// The degrees of freedom as people read them, three of position and three of turn.
inline constexpr std::array kDegreesOfFreedom = {"x", "y", "z", "yaw", "pitch", "roll"};

}  // namespace capstan::learning
