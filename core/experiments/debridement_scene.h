#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/learning/model/command_correction.h"
#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::experiments {

/// Grid of the foam fragments: 8 × 8 × 2 cm (GPR paper, section V-B) under the arm; its lowest layer is the
/// platform. All poses are camera measurements; the cameras' base frame is taken as the robot's frame 0.
struct DebridementScene {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< middle of the platform [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();      ///< unit columns lateral, depth, up
  Eigen::Matrix3d grasping = Eigen::Matrix3d::Identity();  ///< rotation of the tool over a fragment of yaw 0
  robot::JointVector start;  ///< nominal joints with the tool on the platform's middle

  /// Pose of the tool at a position of the grid (lateral, depth, height) [m], rotated by yaw [rad] about the
  /// direction of its jaws.
  Eigen::Isometry3d pose(const Eigen::Vector3d& place, double yaw) const;
  static constexpr double kSide = 0.08, kHeight = 0.02;  ///< sides and height of the grid [m]
};

/// Scene in front of a seven-joint arm, its up axis against gravity. Throws base::InputError for another arm.
DebridementScene debridementScene(const robot::Description& robot);

/// A foam fragment.
struct Fragment {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< position: lateral, depth, height [m]
  double yaw = 0.0;                                 ///< [rad]
};
/// Random fragment on the grid widened by `margin` [m], rotated by at most `most_yaw` [rad].
Fragment drawnFragment(base::Random& random, double margin, double most_yaw);

/// Straight motion between two poses with `count` waypoints at equal time steps. Its speed is `speed` [m/s],
/// or lower where the tool would rotate faster than kRotationRate.
std::vector<learning::Waypoint> straightMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                               double speed, int count);
inline constexpr double kRotationRate = 1.5;  ///< largest rotation rate of the tool [rad/s]

}  // namespace capstan::experiments
