#pragma once

#include "core/vision/camera.h"

namespace capstan::vision {

/// A stereo pair like the laboratory's, slightly turned and visibly distorted.
inline StereoRig testRig() {
  StereoRig rig;
  rig.left = {"left", 640, 480, 651.3, 650.1, 322.4, 238.7, {-0.11, 0.09, 0.0007, -0.0004, -0.02}};
  rig.right = {"right", 640, 480, 648.9, 649.6, 317.8, 241.9, {-0.12, 0.10, -0.0005, 0.0006, -0.03}};
  rig.right_from_left.linear() =
      Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.2, 0.9, -0.1).normalized()).toRotationMatrix();
  rig.right_from_left.translation() = Eigen::Vector3d(-0.04795, 0.0006, 0.0012);
  return rig;
}

}  // namespace capstan::vision
