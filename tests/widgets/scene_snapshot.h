#pragma once

#include <cmath>
#include <limits>

#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "tests/support/folders.h"

namespace capstan::test {

inline robot::Description leftArm() {
  return robot::readDescription(resourceFile("robots/raven2_left.yaml"));
}

/// Two cameras of 650 px, 48 mm apart.
inline vision::StereoRig stereoRig() {
  vision::StereoRig rig;
  for (auto* camera : {&rig.left, &rig.right}) {
    camera->fx = camera->fy = 650.0;
    camera->cx = 319.5;
    camera->cy = 239.5;
  }
  rig.right_from_left.translation() = Eigen::Vector3d(-0.048, 0.0, 0.0);
  return rig;
}

/// Half a metre from `target` along −y of frame 0, picture's down along gravity (−x).
inline Eigen::Isometry3d cameraBefore(const Eigen::Vector3d& target) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = -Eigen::Vector3d::UnitZ();
  pose.linear().col(1) = -Eigen::Vector3d::UnitX();
  pose.linear().col(2) = Eigen::Vector3d::UnitY();
  pose.translation() = target - Eigen::Vector3d(0.0, 0.5, -0.024);
  return pose;
}

/// An arm at joints `q` whose tip is known to `sigma` [m] along each axis.
inline tracking::Snapshot snapshotAt(const robot::ArmKinematics& arm, double t, const Eigen::Vector3d& q,
                                     const Eigen::Vector3d& sigma) {
  tracking::Snapshot s;
  s.t = s.t_cam = t;
  s.q_motor = s.dq_motor = s.dq_link_ukf = Eigen::Vector3d::Zero();
  s.q_link_kin = s.q_link_ukf = s.q_link_cam = s.q_link_true = q;
  s.cable_tension = Eigen::Vector3d(23.0, -11.0, 2.3);
  s.tip_ukf = s.tip_kin = s.tip_cam = arm.tip(q);
  s.tip_ukf_covariance = sigma.cwiseAbs2().asDiagonal();
  s.gate = tracking::Gate::kOpen;
  s.camera_images = true;
  for (auto& marker : s.marker) marker.fault = vision::MarkerFault::kNone;
  return s;
}

}  // namespace capstan::test
