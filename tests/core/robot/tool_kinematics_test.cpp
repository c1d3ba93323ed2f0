// The seven-joint arm's kinematics against the chain of its own robot file.
#include "core/robot/tool_kinematics.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/resource.h"
#include "core/robot/kinematics.h"

namespace capstan::robot {
namespace {

class Tool : public ::testing::Test {
 protected:
  Description robot_ = readDescription(base::resource("robots/raven2_left_tool.yaml"));
  ToolKinematics tool_{robot_};
  base::Random random_{3, "joints"};

  JointVector drawn() {
    JointVector q(kToolJoints);
    for (int i = 0; i < kToolJoints; ++i) {
      const Joint& joint = robot_.joints[static_cast<std::size_t>(i)];
      const double margin = 0.05 * (joint.limit_high - joint.limit_low);
      q[i] = random_.uniform(joint.limit_low + margin, joint.limit_high - margin);
    }
    return std::abs(q[2] - 0.47) < 0.02 ? drawn() : q;  // not at the remote centre
  }
};

TEST_F(Tool, liesBetweenTheJaws) {
  const Chain chain(robot_);
  for (int k = 0; k < 200; ++k) {
    const JointVector q = drawn();
    const Eigen::Isometry3d one = chain.linkPose(6, q), two = chain.linkPose(7, q), pose = tool_.pose(q);
    EXPECT_LT((pose.translation() - one.translation()).norm(), 1e-13);
    const Eigen::Vector3d middle = (one.linear().col(0) + two.linear().col(0)).normalized();
    EXPECT_LT((pose.linear().col(0) - middle).norm(), 1e-12);
    EXPECT_LT((pose.linear().col(2) - one.linear().col(2)).norm(), 1e-12);
  }
}

TEST_F(Tool, comesBackToItsJoints) {
  for (int k = 0; k < 2000; ++k) {
    const JointVector q = drawn();
    JointVector near = q;
    for (int i = 0; i < kToolJoints; ++i) near[i] += random_.normal(0.0, i == 2 ? 1e-3 : 0.02);
    const auto found = tool_.solve(tool_.pose(q), q[6], near);
    ASSERT_TRUE(found) << q.transpose();
    EXPECT_LT((*found - q).cwiseAbs().maxCoeff(), 1e-8) << q.transpose();
  }
}

TEST_F(Tool, neverLeavesItsLimits) {
  int refused = 0;
  for (int k = 0; k < 2000; ++k) {
    JointVector q = drawn();
    const int joint = k % kToolJoints;
    const Joint& facts = robot_.joints[static_cast<std::size_t>(joint)];
    const double out = random_.uniform(1e-6, 0.2) * (facts.limit_high - facts.limit_low);
    q[joint] = k % 2 == 0 ? facts.limit_high + out : facts.limit_low - out;
    EXPECT_FALSE(tool_.insideLimits(q));
    const auto found = tool_.solve(tool_.pose(q), q[6], q);
    if (found)
      EXPECT_TRUE(tool_.insideLimits(*found)) << q.transpose();
    else
      ++refused;
  }
  EXPECT_GT(refused, 1500);
}

TEST_F(Tool, refusesOtherRobots) {
  EXPECT_THROW(ToolKinematics(readDescription(base::resource("robots/raven2_left.yaml"))), base::InputError);
  Description other = robot_;
  other.joints[6].dh.a = 0.01;
  EXPECT_THROW(ToolKinematics{other}, base::InputError);
  other = robot_;
  other.joints[4].type = JointType::kPrismatic;
  EXPECT_THROW(ToolKinematics{other}, base::InputError);
}

}  // namespace
}  // namespace capstan::robot
