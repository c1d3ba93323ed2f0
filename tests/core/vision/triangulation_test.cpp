#include "core/vision/triangulation.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <opencv2/calib3d.hpp>

#include "core/base/random.h"
#include "tests/core/vision/rig_for_tests.h"

namespace capstan::vision {
namespace {

Eigen::Vector3d pointInView(base::Random& random) {
  const double z = random.uniform(0.35, 0.75);
  return {z * random.uniform(-0.3, 0.35), z * random.uniform(-0.3, 0.3), z};
}

struct Seen {
  Eigen::Vector2d left, right;
};

Seen see(const StereoRig& rig, const Eigen::Vector3d& point) {
  return {*rig.left.project(point), *rig.right.project(rig.right_from_left * point)};
}

TEST(Triangulator, UndoesExactProjection) {
  const StereoRig rig = testRig();
  const Triangulator triangulator(rig);
  base::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point = pointInView(random);
    const Seen seen = see(rig, point);
    const Triangulation found = triangulator.triangulate(seen.left, seen.right, 0.1, 0.1);
    ASSERT_TRUE(found.found());
    EXPECT_LT((found.position - point).norm(), 1e-11);
    EXPECT_NEAR(found.epipolar_residual, 0.0, 1e-9);
    EXPECT_LT(found.chi_square, 1e-15);
  }
}

TEST(Triangulator, AgreesWithOpenCvOnConsistentPixels) {
  const StereoRig rig = testRig();
  const Triangulator triangulator(rig);
  base::Random random(2);
  const auto matrix = [](const Camera& c) {
    return cv::Mat((cv::Mat_<double>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1));
  };
  const auto ideal = [&](const Camera& camera, const Eigen::Vector2d& pixel) {
    std::vector<cv::Point2d> out;
    cv::undistortPoints(std::vector<cv::Point2d>{{pixel.x(), pixel.y()}}, out, matrix(camera),
                        std::vector<double>(camera.distortion.begin(), camera.distortion.end()),
                        cv::noArray(), cv::noArray(),
                        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-14));
    return cv::Mat((cv::Mat_<double>(2, 1) << out[0].x, out[0].y));
  };
  cv::Mat p_left = cv::Mat::eye(3, 4, CV_64F), p_right(3, 4, CV_64F), homogeneous;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) p_right.at<double>(i, j) = rig.right_from_left.matrix()(i, j);
  for (int i = 0; i < 200; ++i) {
    const Seen seen = see(rig, pointInView(random));
    cv::triangulatePoints(p_left, p_right, ideal(rig.left, seen.left), ideal(rig.right, seen.right),
                          homogeneous);
    const Eigen::Vector3d expected =
        Eigen::Vector3d(homogeneous.at<double>(0), homogeneous.at<double>(1), homogeneous.at<double>(2)) /
        homogeneous.at<double>(3);
    EXPECT_LT((triangulator.triangulate(seen.left, seen.right, 0.1, 0.1).position - expected).norm(), 1e-8);
  }
}

TEST(Triangulator, CovarianceAndResidualsMatchTheScatterOfNoisyPixels) {
  const StereoRig rig = testRig();
  const Triangulator triangulator(rig);
  base::Random random(3);
  const Eigen::Vector3d point(0.05, -0.04, 0.55);
  const Seen seen = see(rig, point);
  constexpr int kTrials = 20000;
  constexpr double kSigmaLeft = 0.2, kSigmaRight = 0.4;
  const Triangulation exact = triangulator.triangulate(seen.left, seen.right, kSigmaLeft, kSigmaRight);
  double nees = 0.0, chi_square = 0.0, epipolar = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const auto noise = [&](double sigma) {
      return Eigen::Vector2d(random.normal(0, sigma), random.normal(0, sigma));
    };
    const Triangulation found = triangulator.triangulate(
        seen.left + noise(kSigmaLeft), seen.right + noise(kSigmaRight), kSigmaLeft, kSigmaRight);
    ASSERT_TRUE(found.found());
    const Eigen::Vector3d error = found.position - point;
    nees += error.dot(found.covariance.llt().solve(error)) / kTrials;
    chi_square += found.chi_square / kTrials;
    epipolar += found.epipolar_residual * found.epipolar_residual / kTrials;
  }
  // Means of chi-square variables over 20,000 draws: sigma sqrt(2 k / 20000), bands of four.
  EXPECT_NEAR(nees, 3.0, 0.07);
  EXPECT_NEAR(chi_square, 1.0, 0.04);
  EXPECT_NEAR(std::sqrt(epipolar), std::hypot(kSigmaLeft, kSigmaRight), 0.03);
  // Depth noise z² / (f b) times that of the disparity is the largest direction.
  const double depth = 0.55 * 0.55 / (650.0 * rig.baseline()) * std::hypot(kSigmaLeft, kSigmaRight);
  EXPECT_NEAR(std::sqrt(exact.covariance(2, 2)), depth, 0.1 * depth);
}

TEST(Triangulator, EpipolarResidualTellsAMismatchedPair) {
  const StereoRig rig = testRig();
  const Seen seen = see(rig, {0.0, 0.0, 0.5});
  const Triangulation found =
      Triangulator(rig).triangulate(seen.left, seen.right + Eigen::Vector2d(0, 5), 0.1, 0.1);
  EXPECT_NEAR(std::abs(found.epipolar_residual), 5.0, 0.1);
  EXPECT_NEAR(found.chi_square, 25.0 / 0.02, 50.0);
}

TEST(Triangulator, AnswersParallelAndCrossedRaysAsValues) {
  const StereoRig rig = testRig();
  const Triangulator triangulator(rig);
  const Eigen::Vector3d direction(0.1, 0.05, 1.0);
  const Eigen::Vector2d left = *rig.left.project(direction);
  const Eigen::Vector2d parallel = *rig.right.project(rig.right_from_left.linear() * direction);
  EXPECT_EQ(triangulator.triangulate(left, parallel, 0.1, 0.1).fault, TriangulationFault::kParallelRays);
  const Eigen::Vector2d crossed =
      *rig.right.project(rig.right_from_left.linear() * Eigen::Vector3d(0.3, 0.05, 1.0));
  EXPECT_EQ(triangulator.triangulate(left, crossed, 0.1, 0.1).fault, TriangulationFault::kBehindCamera);
}

}  // namespace
}  // namespace capstan::vision
