#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "core/robot/arm_kinematics.h"
#include "core/vision/camera.h"

namespace capstan::live {

/// The instrument projected into both images by a registration. If the registration is good, the projection
/// covers the real instrument.
struct ArmOverlay {
  struct Side {
    std::vector<Eigen::Vector2d>
        shaft;  ///< points from the remote centre to the marker, with lens distortion [px]
    std::optional<Eigen::Vector2d> marker;  ///< centre [px]; nothing if it is behind the camera
    double marker_radius = 0.0;             ///< radius in the image [px]
  };
  std::array<Side, 2> sides;  ///< left, right
};

/// Projects the line from the remote centre to the marker at joints `q` (rad, rad, m). Points behind a camera
/// or more than one frame outside its image are excluded. `marker_radius` [m].
ArmOverlay projectArm(const robot::ArmKinematics& arm, double marker_radius, const vision::StereoRig& rig,
                      const Eigen::Isometry3d& base_from_camera, const Eigen::Vector3d& q);

}  // namespace capstan::live
