#include "core/vision/camera_ray.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/vision/rig_for_tests.h"

namespace capstan::vision {
namespace {

TEST(CameraRay, GoesThroughThePointThatTheCameraSees) {
  const StereoRig rig = testRig();
  base::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double z = random.uniform(0.35, 0.75);
    const Eigen::Vector3d point(z * random.uniform(-0.3, 0.35), z * random.uniform(-0.3, 0.3), z);
    for (int side = 0; side < 2; ++side) {
      MarkerDetection marker;
      marker.fault = MarkerFault::kNone;
      marker.centroid =
          side == 0 ? *rig.left.project(point) : *rig.right.project(rig.right_from_left * point);
      marker.sigma = 0.1;
      const CameraRay ray = rayThrough(rig, side, marker);
      EXPECT_LT((ray.nearest(point) - point).norm(), 1e-10);
      const Eigen::Vector3d aside = point + 0.01 * ray.direction.unitOrthogonal();
      EXPECT_NEAR((ray.nearest(aside) - aside).norm(), 0.01, 1e-10);
      const Eigen::Matrix3d covariance = ray.covariance(point);
      EXPECT_NEAR((covariance * ray.direction).norm(), 0.0, 1e-15) << "nothing is known along the ray by it";
      EXPECT_NEAR(std::sqrt(covariance.trace() / 2.0), 0.1 / 650.0 * point.norm(), 3e-5);
    }
  }
}

}  // namespace
}  // namespace capstan::vision
