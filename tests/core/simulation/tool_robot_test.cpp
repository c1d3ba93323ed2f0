// The arm behind its controller, and the cameras that see it.
#include "core/simulation/tool_robot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/base/units.h"
#include "core/simulation/pose_camera.h"

namespace capstan::simulation {
namespace {

using robot::JointVector;

const robot::Description& raven() {
  static const auto robot = robot::readDescription(base::resource("robots/raven2_left_tool.yaml"));
  return robot;
}

JointVector middle() {
  JointVector q(robot::kToolJoints);
  q << base::toRadians(33.0), base::toRadians(92.0), 0.315, 0.0, 0.0, -0.1, 0.2;
  return q;
}

Eigen::Isometry3d beside(const Eigen::Isometry3d& pose, const Eigen::Vector3d& by) {
  Eigen::Isometry3d moved = pose;
  moved.translation() += by;
  return moved;
}

void goTo(ToolRobot& robot, const Eigen::Isometry3d& goal) {
  for (int k = 0; k < 200; ++k) {
    EXPECT_TRUE(robot.ask(goal, 0.2));
    robot.advance();
  }
}

TEST(ToolRobot, arrivesWhereItIsAskedWhereNothingIsWrong) {
  ToolRobot robot(raven(), {}, middle());
  const Eigen::Isometry3d goal = beside(robot.commanded(), {0.02, -0.03, 0.01});
  goTo(robot, goal);
  EXPECT_LT((robot.arm().pose().translation() - goal.translation()).norm(), 1e-3);
  EXPECT_NEAR(robot.time(), 2.0, 1e-9);
}

TEST(ToolRobot, believesToBeWhereItIsNot) {
  ToolRobot robot(raven(), readToolTruth(base::resource("truth/debridement.yaml")), middle());
  const Eigen::Isometry3d goal = beside(robot.commanded(), {0.02, -0.03, 0.01});
  goTo(robot, goal);
  EXPECT_LT((robot.nominalPose().translation() - goal.translation()).norm(), 1e-3);
  EXPECT_GT((robot.arm().pose().translation() - goal.translation()).norm(), 5e-3);
}

TEST(ToolRobot, refusesWhatIsBeyondItsLimits) {
  ToolRobot robot(raven(), {}, middle());
  const Eigen::Isometry3d before = robot.commanded();
  EXPECT_FALSE(robot.canTake(beside(before, {0.0, 0.5, 0.0}), 0.2));
  EXPECT_FALSE(robot.ask(beside(before, {0.0, 0.5, 0.0}), 0.2));
  EXPECT_FALSE(robot.ask(before, 2.0));  // jaws that open too wide
  EXPECT_EQ(robot.commanded().matrix(), before.matrix());
  JointVector outside = middle();
  outside[2] = 0.6;
  EXPECT_THROW(ToolRobot(raven(), {}, outside), base::InputError);
}

TEST(PoseCamera, seesThroughItsErrors) {
  PoseCameraTruth truth;
  truth.registration_rotation = {0.0, 0.0, base::toRadians(90.0)};
  truth.registration_shift = {0.1, 0.0, 0.0};
  truth.latency = 0.05;
  PoseCamera camera(truth, 1);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.2, 0.0, 0.3);
  const PoseObservation observation = camera.see(1.0, pose);
  EXPECT_TRUE(observation.observed);
  EXPECT_DOUBLE_EQ(observation.t, 1.05);
  EXPECT_LT((observation.pose.translation() - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
}

TEST(PoseCamera, hasNoiseJumpsAndMisses) {
  PoseCameraTruth truth;
  truth.position_sigma = 1e-3;
  truth.jump_rate = 0.5;
  truth.miss_share = 0.1;
  PoseCamera camera(truth, 2);
  double squares = 0.0;
  int still = 0, jumped = 0, missed = 0;
  constexpr int kSamples = 20'000;
  for (int k = 0; k < kSamples; ++k) {
    const PoseObservation observation = camera.see(0.01 * k, Eigen::Isometry3d::Identity());
    if (!observation.observed) {
      ++missed;
      EXPECT_EQ(observation.pose.matrix(), Eigen::Isometry3d::Identity().matrix());
    } else if (observation.pose.translation().norm() > 6e-3) {
      ++jumped;
    } else {
      ++still;
      squares += observation.pose.translation().squaredNorm();
    }
  }
  EXPECT_NEAR(missed, 0.1 * kSamples, 200);
  EXPECT_NEAR(std::sqrt(squares / (3.0 * still)), 1e-3, 5e-5);
  EXPECT_NEAR(jumped, 0.9 * 0.5 * 0.1 * kSamples, 450);  // half of a second a tenth
}

}  // namespace
}  // namespace capstan::simulation
