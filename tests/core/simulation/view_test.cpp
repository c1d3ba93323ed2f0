#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/robot/arm_kinematics.h"
#include "core/simulation/camera_mounting.h"
#include "core/simulation/trajectory.h"
#include "tests/core/simulation/simulated_robot.h"
#include "tests/support/folders.h"

namespace capstan::simulation {
namespace {

/// Smallest distance of a point's projections from the border of both images [px]; negative: out of view.
double margin(const vision::StereoRig& rig, const Eigen::Vector3d& point) {
  double least = 1e9;
  for (const auto& [camera, place] :
       {std::pair{rig.left, point}, std::pair{rig.right, Eigen::Vector3d(rig.right_from_left * point)}}) {
    const auto pixel = camera.project(place);
    if (!pixel) return -1e9;
    least = std::min(
        {least, pixel->x(), pixel->y(), camera.width - 1.0 - pixel->x(), camera.height - 1.0 - pixel->y()});
  }
  return least;
}

class View : public testing::TestWithParam<const char*> {};

TEST_P(View, NominalRotationIsAlongTheBaseAxes) {
  const robot::Description robot = raven(GetParam());
  const Eigen::Matrix3d rotation = nominalBaseFromCamera(robot).linear();
  EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
  EXPECT_LT((rotation.cwiseAbs().array() * (1.0 - rotation.cwiseAbs().array())).abs().maxCoeff(), 1e-12);
  EXPECT_LT((rotation.col(1) - robot.gravity.normalized()).norm(), 1e-12);  // the picture's down
  EXPECT_LT(std::abs(rotation.col(2).dot(robot.gravity)), 1e-9);            // level view
}

TEST(Mounting, LeftArmsRotationIsTheDocumentedOne) {
  Eigen::Matrix3d documented;
  documented.col(0) = -Eigen::Vector3d::UnitZ();
  documented.col(1) = -Eigen::Vector3d::UnitX();
  documented.col(2) = Eigen::Vector3d::UnitY();
  EXPECT_LT((nominalBaseFromCamera(raven()).linear() - documented).norm(), 1e-12);
}

TEST_P(View, BothCamerasSeeTheWholeTaskAndTheHardStop) {
  const robot::Description robot = raven(GetParam());
  const robot::ArmKinematics kinematics(robot);
  const std::string folder = test::resourceFile("cameras/");
  const vision::StereoRig rig = vision::readStereoRig(folder + "left.yaml", folder + "right.yaml");
  for (const Truth& truth : {Truth{}, defaultTruth()}) {
    const Eigen::Isometry3d camera_from_base = trueBaseFromCamera(robot, truth.cameras).inverse();
    const Eigen::Vector3d stop = robot::homingOf(robot);
    EXPECT_GT(margin(rig, camera_from_base * kinematics.tip(stop)), 20.0);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      TrajectorySpec spec;
      spec.duration = 80.0;
      const auto trajectory = makeTrajectory(spec, robot, seed);
      for (double t = 0.0; t < 80.0; t += 0.1) {
        Eigen::Vector3d q = trajectory->at(t).position;
        if (truth.joints[0].link_radius) q[0] *= robot.drives[0].link_radius / *truth.joints[0].link_radius;
        const Eigen::Vector3d tip = camera_from_base * kinematics.tip(q);
        ASSERT_GT(margin(rig, tip), 50.0) << "seed " << seed << ", t = " << t;
        ASSERT_GT(tip.z(), 0.4);
        ASSERT_LT(tip.z(), 0.7);
      }
    }
  }
}

TEST(Mounting, TheDefaultSinusoidStaysInView) {
  const robot::Description robot = raven();
  const robot::ArmKinematics kinematics(robot);
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kSinusoid;
  const auto trajectory = makeTrajectory(spec, robot, 1);
  const Eigen::Isometry3d camera_from_base = nominalBaseFromCamera(robot).inverse();
  for (double t = 0.0; t < spec.duration; t += 0.05)
    ASSERT_GT(margin(testRig(), camera_from_base * kinematics.tip(trajectory->at(t).position)), 10.0);
}

TEST(Mounting, RotationErrorTurnsTheRigAboutItself) {
  CameraTruth cameras;
  cameras.rotation_error = {0.0, 0.02, 0.0};
  const Eigen::Isometry3d nominal = nominalBaseFromCamera(raven()),
                          real = trueBaseFromCamera(raven(), cameras);
  EXPECT_EQ(nominal.translation(), real.translation());
  const Eigen::AngleAxisd between(nominal.linear().transpose() * real.linear());
  EXPECT_NEAR(between.angle(), 0.02, 1e-12);
  EXPECT_NEAR(between.axis().y(), 1.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Arms, View, testing::Values("left", "right"));

}  // namespace
}  // namespace capstan::simulation
