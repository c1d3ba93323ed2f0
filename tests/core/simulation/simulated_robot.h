#pragma once

#include <algorithm>
#include <string>

#include "core/robot/description.h"
#include "core/simulation/simulated_source.h"
#include "core/simulation/truth.h"
#include "core/vision/camera.h"
#include "tests/support/folders.h"

namespace capstan::simulation {

inline robot::Description raven(const std::string& side = "left") {
  return robot::readDescription(test::resourceFile("robots/raven2_" + side + ".yaml"));
}

/// Two cameras like those on the robot: 640×480, f = 650 px, 48 mm apart, with barrel distortion.
inline vision::StereoRig testRig() {
  vision::StereoRig rig;
  rig.left.fx = rig.left.fy = 650.0;
  rig.left.cx = 321.3;
  rig.left.cy = 238.6;
  rig.left.distortion = {-0.12, 0.05, 4e-4, -3e-4, 0.0};
  rig.right = rig.left;
  rig.right.cx = 317.8;
  rig.right_from_left.translation() = Eigen::Vector3d(-0.048, 0.0, 0.0);
  return rig;
}

/// A short session without cameras at the matched truth; tests change what they are about.
inline SimulatedOptions quietOptions(double duration) {
  SimulatedOptions options;
  options.robot = raven();
  options.truth = Truth{};
  options.trajectory.duration = duration;
  return options;
}

}  // namespace capstan::simulation
