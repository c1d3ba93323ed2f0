#include "core/vision/camera_ray.h"

namespace capstan::vision {

CameraRay rayThrough(const StereoRig& rig, int side, const MarkerDetection& marker) {
  const Camera& camera = side == 0 ? rig.left : rig.right;
  const Eigen::Vector3d seen = camera.normalise(marker.centroid).homogeneous();
  CameraRay ray;
  ray.direction = seen.normalized();
  ray.sigma = marker.sigma / (0.5 * (camera.fx + camera.fy) * seen.norm());
  if (side == 0) return ray;
  const Eigen::Isometry3d left_from_right = rig.right_from_left.inverse();
  ray.origin = left_from_right.translation();
  ray.direction = left_from_right.linear() * ray.direction;
  return ray;
}

}  // namespace capstan::vision
