#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/kinematics.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class ToolPose : public ::testing::TestWithParam<const char*> {
 protected:
  Description robot_ = testing::raven(GetParam());
  ArmKinematics arm_{robot_};
  base::Random random_{5};

  /// Arm inside its limits and at least 1 mm from the remote centre, wrist within ±86 degrees.
  Vector6d randomPosition() {
    Vector6d q;
    q << testing::randomInside(random_, robot_), testing::randomVector(random_, 1.5);
    return std::abs(q[2] - 0.47) < 1e-3 ? randomPosition() : q;
  }
};

INSTANTIATE_TEST_SUITE_P(Raven, ToolPose, ::testing::Values("left", "right"),
                         [](const auto& side) { return std::string(side.param); });

/// Frame 6 from the rows alone.
Isometry3d poseByRows(const Description& robot, const Vector6d& q) {
  Isometry3d pose = Chain(robot).linkPose(3, Vector3d(q.head<3>()));
  for (std::size_t i = 0; i < 3; ++i)
    pose =
        pose * JointTransform(robot.wrist[i], JointType::kRevolute).at(q[3 + static_cast<Eigen::Index>(i)]);
  return pose;
}

TEST_P(ToolPose, isTheProductOfTheRows) {
  for (int k = 0; k < 1000; ++k) {
    const Vector6d q = randomPosition();
    ASSERT_LT((arm_.toolPose(q).matrix() - poseByRows(robot_, q).matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST_P(ToolPose, inverseUndoesForwardBranchByBranch) {
  double worst_position = 0.0, worst_rotation = 0.0, worst_joint = 0.0;
  int solved = 0;
  for (int k = 0; k < 100'000; ++k) {
    const Vector6d q = randomPosition();
    const Isometry3d pose = arm_.toolPose(q);
    const Vector3d seen = pose.linear().transpose() * pose.translation();
    if (std::hypot(seen.x(), seen.y()) < 1e-3)
      continue;  // remote centre within 1 mm of the jaw axis: q6 nearly free
    for (const Vector6d& branch : arm_.poseBranches(pose)) {
      const Isometry3d again = arm_.toolPose(branch);
      worst_position = std::max(worst_position, (again.translation() - pose.translation()).norm());
      worst_rotation = std::max(worst_rotation, (again.linear() - pose.linear()).cwiseAbs().maxCoeff());
    }
    Vector6d last = q;
    for (Eigen::Index i = 0; i < 6; ++i) last[i] += random_.normal(0.0, i == 2 ? 1e-3 : 0.01);
    const auto found = arm_.solvePose(pose, last);
    ASSERT_TRUE(found) << q.transpose();
    worst_joint = std::max(worst_joint, (*found - q).cwiseAbs().maxCoeff());
    ++solved;
  }
  fmt::print("{}: {} poses: position within {:.2e} m, rotation {:.2e}, joints {:.2e}\n", GetParam(), solved,
             worst_position, worst_rotation, worst_joint);
  EXPECT_GT(solved, 95'000);
  EXPECT_LE(worst_position, 1e-10);
  EXPECT_LE(worst_rotation, 1e-10);
  EXPECT_LE(worst_joint, 1e-10);
}

TEST_P(ToolPose, wristAnglesStayOnTheTurnOfTheLastPosition) {
  Vector6d q;
  q << 0.6, 1.5, 0.4, 2.0 * std::numbers::pi + 0.3, 0.2, -0.4;
  const auto found = arm_.solvePose(arm_.toolPose(q), q);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - q).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(ToolPose, faultsAreValues) {
  Isometry3d pose = Isometry3d::Identity();
  EXPECT_EQ(arm_.solvePose(pose, Vector6d::Zero()).error(), ReachFault::kSingular);
  Vector6d q;
  q << 0.6, 1.5, 0.95, 0.1, 0.2, -0.4;
  EXPECT_EQ(arm_.solvePose(arm_.toolPose(q), q).error(), ReachFault::kOutsideLimits);
  const Vector3d axis =
      arm_.frame(1, Vector3d::Zero()).linear().col(2);  // 0.5 m along axis 1, jaw axis across
  pose.translation() = 0.5 * axis;
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis).toRotationMatrix();
  EXPECT_EQ(arm_.solvePose(pose, q).error(), ReachFault::kOutOfReach);
}

TEST(ToolWrist, refusesOtherShapes) {
  Description robot = testing::raven();
  robot.wrist[1].alpha = 1.0;
  EXPECT_THROW(ArmKinematics{robot}, base::InputError);
  robot = testing::raven();
  robot.wrist.pop_back();
  EXPECT_THROW(ArmKinematics{robot}, base::InputError);
  robot.wrist.clear();
  EXPECT_FALSE(ArmKinematics{robot}.hasWrist());
}

}  // namespace
}  // namespace capstan::robot
