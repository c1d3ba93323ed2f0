#include "core/robot/arm_kinematics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/robot/kinematics.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using Eigen::Vector3d;

constexpr double kRemoteCentre = 0.47;  // q3 [m]

class BothArms : public ::testing::TestWithParam<const char*> {
 protected:
  Description robot_ = testing::raven(GetParam());
  ArmKinematics arm_{robot_};
  base::Random random_{2};

  /// Inside the limits, one in four close to the remote centre: its distance is drawn by magnitude from 2 µm
  /// to 10 mm.
  Vector3d randomPosition() {
    Vector3d q = testing::randomInside(random_, robot_);
    if (random_.uniform(0.0, 1.0) < 0.25)
      q[2] = kRemoteCentre +
             std::pow(10.0, random_.uniform(-5.7, -2.0)) * (random_.uniform(-1.0, 1.0) < 0.0 ? -1 : 1);
    return std::abs(q[2] - kRemoteCentre) < 2e-6 ? randomPosition() : q;
  }
};

INSTANTIATE_TEST_SUITE_P(Raven, BothArms, ::testing::Values("left", "right"),
                         [](const auto& side) { return std::string(side.param); });

TEST_P(BothArms, tipAndFramesAreThoseOfTheTableOfRows) {
  const Chain chain(robot_);
  for (int k = 0; k < 1000; ++k) {
    const Vector3d q = testing::randomVector(random_, 3.0);
    ASSERT_LT((arm_.tip(q) - chain.marker(q)).norm(), 1e-14);
    for (int i = 0; i <= 3; ++i)
      ASSERT_LT((arm_.frame(i, q).matrix() - chain.linkPose(i, q).matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST_P(BothArms, inverseUndoesForwardBranchByBranch) {
  double worst_tip = 0.0, worst_joint = 0.0;
  long total = 0;
  for (int k = 0; k < 500'000; ++k) {
    const Vector3d q = randomPosition();
    const Vector3d tip = arm_.tip(q);
    const auto branches = arm_.positionBranches(tip);
    ASSERT_GE(branches.count, 2) << q.transpose();
    total += branches.count;
    double nearest = 1.0;
    for (const Vector3d& branch : branches) {
      worst_tip = std::max(worst_tip, (arm_.tip(branch) - tip).norm());
      nearest = std::min(nearest, (branch - q).cwiseAbs().maxCoeff());
    }
    worst_joint = std::max(worst_joint, nearest);
  }
  fmt::print("{}: 500,000 poses, {} branches: tip within {:.2e} m, own branch within {:.2e} rad or m\n",
             GetParam(), total, worst_tip, worst_joint);
  EXPECT_LE(worst_tip, 1e-10);
  EXPECT_LE(worst_joint, 1e-10);
}

TEST_P(BothArms, theNearestBranchInsideTheLimitsIsTheArmsOwn) {
  for (int k = 0; k < 100'000; ++k) {
    const Vector3d q = randomPosition();
    const Vector3d last =
        q + Vector3d(random_.normal(0, 0.02), random_.normal(0, 0.02), random_.normal(0, 0.002));
    const auto found = arm_.solvePosition(arm_.tip(q), last);
    ASSERT_TRUE(found) << q.transpose();
    ASSERT_LT((*found - q).cwiseAbs().maxCoeff(), 1e-10) << q.transpose();
  }
}

TEST_P(BothArms, allBranchesMapBackOverTheWholeCircle) {
  double worst = 0.0;
  for (int k = 0; k < 100'000; ++k) {
    Vector3d q(random_.uniform(-3.1, 3.1), random_.uniform(-3.1, 3.1), random_.uniform(-0.3, 1.3));
    if (k % 4 == 0)
      q[1] = random_.uniform(-1.0, 1.0) * std::pow(10.0, random_.uniform(-12, 0));  // folded elbow
    const Vector3d tip = arm_.tip(q);
    const auto branches = arm_.positionBranches(tip);
    ASSERT_GT(branches.count, 0) << q.transpose();
    for (const Vector3d& branch : branches) worst = std::max(worst, (arm_.tip(branch) - tip).norm());
  }
  EXPECT_LE(worst, 1e-10);
}

TEST_P(BothArms, theHardStopIsReachable) {
  Vector3d stop;
  for (int i = 0; i < 3; ++i) stop[i] = robot_.joints[static_cast<std::size_t>(i)].homing;
  EXPECT_TRUE(arm_.insideLimits(stop));
  const auto found = arm_.solvePosition(arm_.tip(stop), stop);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - stop).cwiseAbs().maxCoeff(), 1e-12);
  // A camera that sees the resting arm 3 mm off still yields a position.
  for (int k = 0; k < 1000; ++k)
    EXPECT_TRUE(arm_.solvePosition(arm_.tip(stop) + testing::randomVector(random_, 3e-3), stop));
}

TEST_P(BothArms, remoteCentreIsSingular) {
  const Vector3d q(0.5, 1.6, kRemoteCentre);
  EXPECT_EQ(arm_.solvePosition(arm_.tip(q), q).error(), ReachFault::kSingular);
  EXPECT_EQ(arm_.solvePosition(arm_.tip(q + Vector3d(0, 0, 0.9e-6)), q).error(), ReachFault::kSingular);
  EXPECT_TRUE(arm_.solvePosition(arm_.tip(q + Vector3d(0, 0, 1.1e-6)), q));
}

TEST_P(BothArms, axisOfJoint1IsOutOfReach) {
  // Twists of 75 and 128 (52) degrees keep the tool at least 23 degrees off that axis.
  const Vector3d axis = arm_.frame(1, Vector3d::Zero()).linear().col(2);
  EXPECT_EQ(arm_.solvePosition(0.1 * axis, {0.5, 1.5, 0.4}).error(), ReachFault::kOutOfReach);
}

TEST_P(BothArms, aTipBesideTheLimitsSaysSo) {
  const Vector3d q(0.5, 1.6, 0.9);
  EXPECT_EQ(arm_.solvePosition(arm_.tip(q), q).error(), ReachFault::kOutsideLimits);
}

TEST_P(BothArms, jacobianIsTheDerivativeOfTheTip) {
  const Chain chain(robot_);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 100; ++k) {
    const Vector3d q = testing::randomInside(random_, robot_);
    const Eigen::Matrix3d jacobian = arm_.tipJacobian(q);
    for (int i = 0; i < 3; ++i) {
      const Vector3d h = kStep * Vector3d::Unit(i);
      const Vector3d slope = (arm_.tip(q + h) - arm_.tip(q - h)) / (2.0 * kStep);
      EXPECT_LT((jacobian.col(i) - slope).norm(), 1e-10);
    }
    EXPECT_LT((chain.markerJacobian(q).bottomRows<3>() - jacobian).norm(), 1e-13);
  }
}

TEST(ArmKinematics, wherePitchReachesAxis1TheFirstJointIsFree) {
  Description robot = testing::raven();
  robot.joints[1].dh.alpha = base::toRadians(52.0);
  robot.joints[2].dh.alpha = base::toRadians(52.0);
  const ArmKinematics arm(robot);
  const Vector3d axis = arm.frame(1, Vector3d::Zero()).linear().col(2);
  EXPECT_EQ(arm.solvePosition(0.1 * axis, {0.5, 1.5, 0.4}).error(), ReachFault::kSingular);
}

TEST(ArmKinematics, markerBesideTheToolAxis) {
  Description robot = testing::raven();
  robot.marker = {0.006, -0.004, -0.45};
  const ArmKinematics arm(robot);
  base::Random random(3);
  double worst = 0.0;
  for (int k = 0; k < 100'000; ++k) {
    const Vector3d q = testing::randomInside(random, robot);
    const Vector3d tip = arm.tip(q);
    const auto branches = arm.positionBranches(tip);
    ASSERT_GE(branches.count, 2);
    for (const Vector3d& branch : branches) worst = std::max(worst, (arm.tip(branch) - tip).norm());
  }
  EXPECT_LE(worst, 1e-10);
  EXPECT_EQ(arm.solvePosition({0.001, 0.002, 0.001}, {0.5, 1.5, 0.4}).error(), ReachFault::kOutOfReach);
}

TEST(ArmKinematics, refusesArmsWithoutARemoteCentre) {
  Description robot = testing::raven();
  robot.joints[1].dh.a = 0.1;
  try {
    const ArmKinematics arm(robot);
    FAIL() << "took an arm without a remote centre";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "joints[1].dh.a");
    EXPECT_EQ(error.fault().value, "0.1");
  }
  robot = testing::raven();
  robot.joints[2].type = JointType::kRevolute;
  EXPECT_THROW(ArmKinematics{robot}, base::InputError);
  robot = testing::raven();
  robot.joints.pop_back();
  EXPECT_THROW(ArmKinematics{robot}, base::InputError);
}

}  // namespace
}  // namespace capstan::robot
