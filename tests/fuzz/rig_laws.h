#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/vision/camera.h"
#include "tests/fuzz/fuzz_target.h"

namespace capstan::fuzz {

/// What holds for every calibration that is accepted.
inline void requireRig(const vision::StereoRig& rig) {
  for (const vision::Camera* camera : {&rig.left, &rig.right}) {
    require(camera->width > 0 && camera->height > 0, "images have a size");
    require(camera->fx > 0.0 && camera->fy > 0.0 && std::isfinite(camera->fx * camera->fy), "focal lengths");
    require(std::isfinite(camera->cx) && std::isfinite(camera->cy), "principal point");
  }
  require(rig.left.width == rig.right.width && rig.left.height == rig.right.height, "images have one size");
  const Eigen::Matrix3d rotation = rig.right_from_left.linear();
  require((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-9, "a rotation");
  require(rotation.determinant() > 0.0, "no reflection");
  require(rig.baseline() > 0.0 && std::isfinite(rig.baseline()), "a baseline");
}

}  // namespace capstan::fuzz
