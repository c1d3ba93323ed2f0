#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "core/robot/arm_kinematics.h"
#include "core/vision/camera.h"

namespace capstan::live {

/// The instrument as both cameras should see it under a registration: what lies over the real one is
/// registered well.
struct ArmOverlay {
  struct Side {
    std::vector<Eigen::Vector2d>
        shaft;  ///< remote centre to marker, bent by the lens; pixels of the frame [px]
    std::optional<Eigen::Vector2d> marker;  ///< centre [px]; nothing when it is behind the camera
    double marker_radius = 0.0;             ///< [px]
  };
  std::array<Side, 2> sides;  ///< left, right
};

/// Projects the line from the remote centre to the marker at joints `q` (rad, rad, m). Points behind a camera
/// or more than one frame outside its image are excluded. `marker_radius` [m].
ArmOverlay projectArm(const robot::ArmKinematics& arm, double marker_radius, const vision::StereoRig& rig,
                      const Eigen::Isometry3d& base_from_camera, const Eigen::Vector3d& q);

}  // namespace capstan::live
