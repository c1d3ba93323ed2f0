#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/learning/model/command_correction.h"
#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::experiments {

/// Where foam fragments lie: an 8 × 8 × 2 cm grid (GPR paper, section V-B) under the arm, its lowest layer
/// the platform. All poses as cameras see them; their base frame is taken for the robot's frame 0.
struct DebridementScene {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< middle of the platform [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();      ///< columns lateral, depth, up; unit
  Eigen::Matrix3d grasping = Eigen::Matrix3d::Identity();  ///< the tool's turn over a fragment of yaw 0
  robot::JointVector start;  ///< nominal joints with the tool on the platform's middle

  /// The tool at a place of the grid (lateral, depth, height) [m], rotated by yaw [rad] about its jaws' own
  /// direction.
  Eigen::Isometry3d pose(const Eigen::Vector3d& place, double yaw) const;
  static constexpr double kSide = 0.08, kHeight = 0.02;  ///< of the grid [m]
};

/// In front of a seven-joint arm, up against gravity. base::InputError: no such arm.
DebridementScene debridementScene(const robot::Description& robot);

/// A foam fragment.
struct Fragment {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< lateral, depth, height [m]
  double yaw = 0.0;                                 ///< [rad]
};
/// Anywhere on the grid widened by `margin` [m], rotated by at most `most_yaw` [rad].
Fragment drawnFragment(base::Random& random, double margin, double most_yaw);

/// From one pose to another in a straight line, at an even speed [m/s] or, where that would turn the tool
/// faster than kRotationRate, slower; `count` waypoints at even times.
std::vector<learning::Waypoint> straightMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                               double speed, int count);
inline constexpr double kRotationRate = 1.5;  ///< [rad/s]

}  // namespace capstan::experiments
