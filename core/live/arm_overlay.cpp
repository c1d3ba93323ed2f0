#include "core/live/arm_overlay.h"

namespace capstan::live {

namespace {

constexpr int kSteps = 24;  // points along the shaft: lens distortion bends the line

bool nearImage(const vision::Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() > -camera.width && pixel.x() < 2 * camera.width && pixel.y() > -camera.height &&
         pixel.y() < 2 * camera.height;
}

}  // namespace

ArmOverlay projectArm(const robot::ArmKinematics& arm, double marker_radius, const vision::StereoRig& rig,
                      const Eigen::Isometry3d& base_from_camera, const Eigen::Vector3d& q) {
  ArmOverlay overlay;
  const Eigen::Vector3d tip = arm.tip(q);
  for (std::size_t side = 0; side < 2; ++side) {
    const vision::Camera& camera = side == 0 ? rig.left : rig.right;
    const Eigen::Isometry3d left_from_base = base_from_camera.inverse();
    const Eigen::Isometry3d camera_from_base =
        side == 0 ? left_from_base : rig.right_from_left * left_from_base;
    auto& out = overlay.sides[side];
    for (int i = 0; i <= kSteps; ++i) {
      const auto pixel = camera.project(camera_from_base * (tip * i / kSteps));
      if (pixel && nearImage(camera, *pixel)) out.shaft.push_back(*pixel);
    }
    const Eigen::Vector3d seen = camera_from_base * tip;
    out.marker = camera.project(seen);
    if (out.marker) out.marker_radius = camera.fx * marker_radius / seen.z();
  }
  return overlay;
}

}  // namespace capstan::live
