#include "core/tracking/camera_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "core/base/random.h"
#include "core/robot/arm_kinematics.h"
#include "core/simulation/truth.h"
#include "tests/core/tracking/pipeline_scene.h"
#include "tests/support/folders.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const robot::Description& raven() {
  static const robot::Description robot =
      robot::readDescription(capstan::test::resourceFile("robots/raven2_left.yaml"));
  return robot;
}

Matrix3d randomCovariance(base::Random& random, double sigma) {
  Matrix3d a;
  for (int i = 0; i < 9; ++i) a(i / 3, i % 3) = random.normal(0.0, sigma);
  return a * a.transpose();
}

TEST(PixelNoise, FindsTheTrueSigmaFromReprojectionErrors) {
  for (const double sigma : {0.5, 1.0, 2.0}) {
    PixelNoise noise(300);
    base::Random random(3, "pixels");
    double mean = 0.0;
    for (int i = 0; i < 3000; ++i) {
      const double error = random.normal(0.0, sigma);
      noise.add(error * error);
      if (i >= 1000) mean += noise.ratio() / 2000.0;
    }
    // Squares beyond kOutlier variances count less: E min(z², 9) = 0.986.
    EXPECT_NEAR(mean, 0.986 * sigma * sigma, 0.06 * sigma * sigma) << sigma;
  }
}

TEST(PixelNoise, BeginsWithTheStatedSigmaAndForgetsAtReset) {
  PixelNoise noise(300);
  noise.add(0.0);
  EXPECT_NEAR(noise.ratio(), 30.0 / 31.0, 1e-12);
  for (int i = 0; i < 100; ++i) noise.add(0.0);
  EXPECT_LT(noise.ratio(), 0.3);
  noise.reset();
  EXPECT_EQ(noise.ratio(), 1.0);
}

TEST(PixelNoise, AStrayPairHardlyCounts) {
  PixelNoise noise(300);
  for (int i = 0; i < 300; ++i) noise.add(1.0);
  noise.add(1e6);
  noise.add(std::nan(""));
  EXPECT_LT(noise.ratio(), 1.03);
}

TEST(PixelNoise, WithoutMemoryTheStatedSigmaIsBelieved) {
  PixelNoise noise(0);
  for (int i = 0; i < 100; ++i) noise.add(0.1);
  EXPECT_EQ(noise.ratio(), 1.0);
}

/// Against errors drawn one by one: pixels, a mounting turned about the marker's place at the hard stop, and
/// its shift, through the exact inverse kinematics.
TEST(CameraNoise, IsTheSpreadOfJointsOverDrawnErrors) {
  TrackingOptions options;
  options.registration_rotation_sigma = 2e-3;
  options.registration_shift_sigma = 2e-4;
  options.camera_clock_sigma = 1e-3;
  const CameraNoise noise(raven(), options);
  const robot::ArmKinematics arm(raven());
  const Vector3d q(0.6, 1.6, 0.33), speed(0.4, -0.7, 0.1);
  const Vector3d tip = arm.tip(q), hard_stop = arm.tip(robot::homingOf(raven()));
  base::Random random(11, "camera errors");
  const Matrix3d pixels = randomCovariance(random, 2e-4);
  const Matrix3d root = pixels.llt().matrixL();
  const auto draw = [&random] { return Vector3d(random.normal(), random.normal(), random.normal()); };

  constexpr int kDraws = 20000;
  Matrix3d spread = Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vector3d rotation = options.registration_rotation_sigma * draw();
    const Eigen::AngleAxisd mounting(rotation.norm(), rotation.normalized());
    const Vector3d seen =
        hard_stop + mounting * (tip - hard_stop) + options.registration_shift_sigma * draw() + root * draw();
    const Vector3d late = options.camera_clock_sigma * random.normal() * speed;
    const Vector3d left = options.camera_sigma_floor.cwiseProduct(draw());
    const auto joints = arm.solvePosition(seen, q);
    ASSERT_TRUE(joints);
    const Vector3d error = *joints - q + late + left;
    spread += error * error.transpose() / kDraws;
  }
  const auto seen = observeJoints(arm, tip, noise.ofImagedTip(tip, pixels), q);
  ASSERT_TRUE(seen);
  const Matrix3d r = noise.ofJoints(*seen, speed, options.camera_clock_sigma);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(spread(i, j), r(i, j), 0.03 * std::sqrt(r(i, i) * r(j, j))) << i << j;
}

TEST(CameraNoise, ATipOfAnotherSystemHasItsStatedSigma) {
  TrackingOptions options;
  options.registration_rotation_sigma = options.registration_shift_sigma = 0.0;
  options.tip_sigma = Vector3d(1e-3, 2e-3, 3e-3);
  const Matrix3d covariance = CameraNoise(raven(), options).ofTip(Vector3d(0.1, 0.0, 0.1));
  EXPECT_LT((covariance - Matrix3d(Vector3d(1e-6, 4e-6, 9e-6).asDiagonal())).norm(), 1e-15);
}

TEST(CameraNoise, ConstantIsTheStatedOneWhereverTheTipIs) {
  TrackingOptions options;
  options.camera_noise = CameraNoiseKind::kConstant;
  options.constant_camera_sigma = Vector3d(0.02, 0.03, 0.004);
  const CameraNoise noise(raven(), options);
  for (const double scale : {1e-6, 1.0}) {
    const Matrix3d r =
        noise.ofJoints({Vector3d::Ones(), scale * Matrix3d::Identity()}, Vector3d::Ones(), 1e-3);
    EXPECT_LT((r - Matrix3d(Vector3d(4e-4, 9e-4, 1.6e-5).asDiagonal())).norm(), 1e-15);
  }
}

/// What the pipeline states of q_cam holds q_cam's error in pictures of a robot with a turned mounting.
TEST(CameraNoise, OfPicturesCoversTheErrorsThatTheSimulatedCamerasMake) {
  simulation::SimulatedSource source(test::simulated(simulation::defaultTruth(), 12.0, true));
  TrackingPipeline pipeline = makePipeline(source.info());
  Vector3d normalised = Vector3d::Zero();
  int count = 0;
  for (Sample sample; source.next(sample);) {
    const Snapshot& s = pipeline.step(sample);
    if (!s.camera_updated || s.gate != Gate::kOpen || !s.q_link_true_cam.allFinite()) continue;
    normalised += (s.q_link_cam - s.q_link_true_cam).cwiseQuotient(s.q_link_cam_sigma).cwiseAbs2();
    ++count;
  }
  ASSERT_GT(count, 100);
  normalised /= count;
  EXPECT_LT(normalised.maxCoeff(), 4.0) << normalised.transpose();
  EXPECT_GT(normalised.sum() / 3.0, 0.1) << normalised.transpose();
}

}  // namespace
}  // namespace capstan::tracking
