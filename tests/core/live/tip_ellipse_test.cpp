// The 2 sigma ellipse of a point in an image, against closed forms and against samples of the distribution.
#include "core/live/tip_ellipse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"

namespace capstan::live {
namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();

vision::Camera pinhole() {
  vision::Camera camera;
  camera.fx = 800.0;
  camera.fy = 820.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  return camera;
}

/// Covariance of the pixel that the ellipse stands for [px²].
Eigen::Matrix2d covarianceOf(const ImageEllipse& ellipse) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(ellipse.angle).toRotationMatrix();
  const Eigen::Vector2d sigma(ellipse.major / 2.0, ellipse.minor / 2.0);
  return turn * sigma.cwiseAbs2().asDiagonal() * turn.transpose();
}

TEST(TipEllipse, OnTheOpticalAxisItsAxesAreThoseOfTheCovariance) {
  const Eigen::Vector3d sigma(0.001, 0.002, 0.05);  // depth is not visible on the axis
  const auto ellipse =
      tipEllipse(pinhole(), Eigen::Isometry3d::Identity(), {0.0, 0.0, 0.4}, sigma.cwiseAbs2().asDiagonal());
  ASSERT_TRUE(ellipse);
  EXPECT_NEAR(ellipse->centre.x(), 320.0, 1e-9);
  EXPECT_NEAR(ellipse->centre.y(), 240.0, 1e-9);
  EXPECT_NEAR(ellipse->major, 2.0 * 820.0 * 0.002 / 0.4, 1e-5);
  EXPECT_NEAR(ellipse->minor, 2.0 * 800.0 * 0.001 / 0.4, 1e-5);
  EXPECT_NEAR(std::abs(std::sin(ellipse->angle)), 1.0, 1e-6);
}

/// Pinhole: u = fx X/Z + cx, so that du/dX = fx/Z and du/dZ = −fx X/Z², and v alike.
TEST(TipEllipse, BesideTheAxisItIsThatOfTheDerivatives) {
  const vision::Camera camera = pinhole();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  pose.pretranslate(Eigen::Vector3d(0.05, -0.02, 0.5));
  const Eigen::Vector3d point(0.08, 0.11, -0.04), seen = pose * point;
  Eigen::Matrix3d root;
  root << 1.0, 0.2, -0.1, 0.0, 2.0, 0.3, 0.0, 0.0, 0.7;
  const Eigen::Matrix3d covariance = 1e-6 * root * root.transpose();
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << camera.fx / seen.z(), 0.0, -camera.fx * seen.x() / (seen.z() * seen.z()), 0.0,
      camera.fy / seen.z(), -camera.fy * seen.y() / (seen.z() * seen.z());
  jacobian = jacobian * pose.linear();
  const auto ellipse = tipEllipse(camera, pose, point, covariance);
  ASSERT_TRUE(ellipse);
  const Eigen::Matrix2d expected = jacobian * covariance * jacobian.transpose();
  EXPECT_LT((covarianceOf(*ellipse) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_GE(ellipse->major, ellipse->minor);
}

TEST(TipEllipse, HoldsTheShareOfTheDistributionThroughADistortingLens) {
  vision::Camera camera = pinhole();
  camera.distortion = {-0.25, 0.08, 0.001, -0.0015, 0.0};
  const Eigen::Vector3d point(0.06, -0.05, 0.3);
  const Eigen::Vector3d sigma(0.0010, 0.0004, 0.0015);
  const auto ellipse =
      tipEllipse(camera, Eigen::Isometry3d::Identity(), point, sigma.cwiseAbs2().asDiagonal());
  ASSERT_TRUE(ellipse);
  base::Random random(3);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-ellipse->angle).toRotationMatrix();
  const int count = 20'000;
  int inside = 0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d drawn(random.normal(), random.normal(), random.normal());
    const Eigen::Vector2d off = turn * (*camera.project(point + sigma.cwiseProduct(drawn)) - ellipse->centre);
    inside += std::hypot(off.x() / ellipse->major, off.y() / ellipse->minor) <= 1.0;
  }
  const double share = 1.0 - std::exp(-2.0);
  EXPECT_NEAR(1.0 * inside / count, share, 5.0 * std::sqrt(share * (1.0 - share) / count));
}

TEST(TipEllipse, NothingWhereNothingCanBeDrawn) {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Matrix3d covariance = 1e-6 * Eigen::Matrix3d::Identity();
  EXPECT_FALSE(tipEllipse(pinhole(), pose, {0.0, 0.0, -0.3}, covariance)) << "behind the camera";
  EXPECT_FALSE(tipEllipse(pinhole(), pose, {0.0, 0.0, 0.3}, covariance * kNaN));
  const auto certain = tipEllipse(pinhole(), pose, {0.0, 0.0, 0.3}, Eigen::Matrix3d::Zero());
  ASSERT_TRUE(certain);
  EXPECT_EQ(certain->major, 0.0);
}

}  // namespace
}  // namespace capstan::live
