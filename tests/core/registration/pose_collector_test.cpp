#include "core/registration/pose_collector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/registration/closure.h"
#include "core/registration/pair_table.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "tests/support/folders.h"

namespace capstan::registration {
namespace {

using testing::HasSubstr;

constexpr double kNoise = 2e-4;  // of the camera's point, per axis [m]

/// An arm that stops for half a second at each of many poses, and moves quickly in between.
class Poses : public ::testing::Test {
 protected:
  Poses() {
    truth_.linear() = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    truth_.translation() = Eigen::Vector3d(0.05, -0.3, 0.1);
  }
  Eigen::Vector3d somewhere() {
    Eigen::Vector3d q;
    for (int joint = 0; joint < 3; ++joint) {
      const auto& limits = robot_.joints[static_cast<std::size_t>(joint)];
      q(joint) = random_.uniform(limits.limit_low, limits.limit_high);
    }
    return q;
  }
  /// Goes to a random pose within the joint limits and rests there. `error` [m] is added to what the cameras
  /// see.
  void visit(double error = 0.0) {
    const Eigen::Vector3d q = somewhere();
    for (int frame = 0; frame < 8; ++frame) show(q, error);
  }
  void show(const Eigen::Vector3d& q, double error) {
    tracking::Snapshot s;
    s.camera_updated = true;
    s.t_cam = t_ += 1.0 / 15.0;
    s.q_link_kin =
        robot::Transmission(collector_.robot()).jointFromMotor(robot::Transmission(robot_).motorFromJoint(q));
    s.tip_kin_cam = arm_.tip(s.q_link_kin);
    s.tip_in_camera = truth_.inverse() * arm_.tip(q) + Eigen::Vector3d(0.0, 0.0, error);
    for (int i = 0; i < 3; ++i) s.tip_in_camera(i) += random_.normal(0.0, kNoise);
    s.tip_in_camera_covariance = kNoise * kNoise * Eigen::Matrix3d::Identity();
    collector_.observe(s);
  }

  robot::Description robot_ = robot::readDescription(test::resourceFile("robots/raven2_left.yaml"));
  robot::ArmKinematics arm_{robot_};
  base::Random random_{1};
  Eigen::Isometry3d truth_ = Eigen::Isometry3d::Identity();
  PoseCollector collector_{robot_};
  double t_ = 0.0;
};

TEST_F(Poses, GiveTheTransformWithItsErrorAtTheTool) {
  visit();
  EXPECT_TRUE(collector_.poses().empty()) << "not asked for";
  collector_.setCollecting(true);
  EXPECT_EQ(collector_.fit().error().fault, PairFault::kTooFewPairs);
  for (int i = 0; i < 20; ++i) visit(i == 7 ? 0.03 : 0.0);
  ASSERT_EQ(collector_.poses().size(), 20u) << "one a rest, none on the way";
  ASSERT_TRUE(collector_.fit().has_value());
  EXPECT_FALSE(collector_.fit()->used[7]);
  const WorkspaceError error95 = collector_.workspaceError();
  EXPECT_LE(error95.median, error95.largest);
  double worst = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d tip = arm_.tip(somewhere());
    worst = std::max(worst, (collector_.fit()->base_from_camera * (truth_.inverse() * tip) - tip).norm());
  }
  EXPECT_LT(worst, 2.0 * error95.largest);
  EXPECT_GT(2.0 * error95.largest, 1e-4) << "an interval that promises what noise cannot keep is none";
}

TEST_F(Poses, AreThoseOfTheRobotsPresentConstants) {
  robot::Description wrong = robot_;
  wrong.drives[0].link_radius *= 1.07;
  wrong.drives[1].link_radius *= 0.98;
  collector_ = PoseCollector(wrong);
  collector_.setCollecting(true);
  for (int i = 0; i < 20; ++i) visit();
  ASSERT_TRUE(collector_.fit().has_value());
  const Eigen::Isometry3d former = collector_.fit()->base_from_camera;
  EXPECT_GT(collector_.fit()->rms, 4.0 * kNoise) << "tips by wrong radii do not fit a rigid motion";
  EXPECT_NEAR(collector_.rmsBy(former), collector_.fit()->rms, 1e-9);
  collector_.setRobot(robot_);
  ASSERT_TRUE(collector_.fit().has_value());
  EXPECT_LT(collector_.fit()->rms, 2.0 * kNoise);
  EXPECT_GT(collector_.rmsBy(former), 5.0 * collector_.fit()->rms);
  EXPECT_LT((collector_.fit()->base_from_camera.translation() - truth_.translation()).norm(), 1e-3);
  collector_.setRobot(wrong);
  EXPECT_LT((collector_.fit()->base_from_camera.translation() - former.translation()).norm(), 1e-9);
}

TEST_F(Poses, AreExcludedAndComeBack) {
  collector_.setCollecting(true);
  for (int i = 0; i < 6; ++i) visit();
  const Eigen::Matrix4d before = collector_.fit()->base_from_camera.matrix();
  const double shift = collector_.fit()->shifts[2];
  EXPECT_GT(shift, 0.0);
  collector_.exclude(2, true);
  EXPECT_EQ(collector_.fitted(), (std::vector<std::size_t>{0, 1, 3, 4, 5}));
  EXPECT_NE(collector_.fit()->base_from_camera.matrix(), before);
  collector_.exclude(2, false);
  EXPECT_EQ(collector_.fit()->base_from_camera.matrix(), before);
  collector_.clear();
  EXPECT_TRUE(collector_.poses().empty());
  EXPECT_FALSE(collector_.collecting());
}

TEST_F(Poses, CheckStaysOutsideTheFit) {
  collector_.setCollecting(true);
  for (int i = 0; i < 12; ++i) visit();
  collector_.check();
  for (int i = 0; i < 5; ++i) visit();
  EXPECT_FALSE(collector_.checking());
  ASSERT_EQ(collector_.checks().size(), PoseCollector::kChecks);
  EXPECT_EQ(collector_.poses().size(), 12u);
  for (const Closure& closure : closuresOf(*collector_.fit(), collector_.checks())) {
    EXPECT_LT(closure.error, 2e-3);
    EXPECT_TRUE(closure.holds());
  }
  EXPECT_THAT(closureWords(closuresOf(*collector_.fit(), collector_.checks())), HasSubstr("holds: errors"));
}

TEST_F(Poses, CheckTheRegistrationInUse) {
  collector_.check();
  for (int i = 0; i < 4; ++i) visit();
  EXPECT_FALSE(collector_.fit().has_value());
  for (const Closure& closure : closuresOf(truth_, collector_.checks())) EXPECT_TRUE(closure.holds());
  const Eigen::Isometry3d tilted = truth_ * Eigen::AngleAxisd(0.09, Eigen::Vector3d::UnitX());
  EXPECT_THAT(closureWords(closuresOf(tilted, collector_.checks())), HasSubstr("does not hold"));
  EXPECT_EQ(closureWords({}), "");
}

TEST_F(Poses, AreSavedForTheCommandLine) {
  collector_.setCollecting(true);
  for (int i = 0; i < 5; ++i) visit();
  const auto file = std::filesystem::temp_directory_path() / "capstan_pose_collector_test.csv";
  collector_.save(file);
  const auto rows = readPairTable(file);
  std::filesystem::remove(file);
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(*rows[3].base, collector_.poses()[3].pair.base);
  EXPECT_EQ(*rows[3].camera, collector_.poses()[3].pair.camera);
}

}  // namespace
}  // namespace capstan::registration
