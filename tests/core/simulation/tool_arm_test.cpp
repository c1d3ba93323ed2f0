// The seven-joint arm's laws by numbers computed by hand.
#include "core/simulation/tool_arm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/simulation/quasi_static.h"

namespace capstan::simulation {
namespace {

using robot::JointVector;
using robot::kToolJoints;

constexpr int kRoll = 3, kWrist = 4;
constexpr double kStep = 1e-3;

class ToolArmLaws : public ::testing::Test {
 protected:
  robot::Description robot_ = robot::readDescription(base::resource("robots/raven2_left_tool.yaml"));
  ToolTruth truth_;
  JointVector motors_ = JointVector::Zero(kToolJoints);

  /// No gravity, and motors that go where they are told.
  void SetUp() override {
    robot_.gravity.setZero();
    for (robot::Drive& drive : robot_.drives) drive.motor_friction = {0.0, 0.0, 1.0};
    truth_.control = {100.0, 0.0};
    motors_ << 200.0, -100.0, -300.0, 0.0, 0.0, 0.0, 0.0;  // somewhere in the middle
  }
  /// Moves a motor by a travel of its cable at a speed of it [m/s].
  void pull(ToolArm& arm, int joint, double travel, double speed) {
    const robot::Drive& drive = robot_.drives[static_cast<std::size_t>(joint)];
    const double lever = drive.motor_capstan_radius / drive.gear_ratio;
    const int steps = static_cast<int>(std::lround(std::abs(travel) / speed / kStep));
    JointVector rate = JointVector::Zero(kToolJoints);
    rate[joint] = std::copysign(speed, travel) / lever;
    for (int k = 0; k < steps; ++k) {
      motors_ += rate * kStep;
      arm.step(motors_, rate, kStep);
    }
  }
  void wait(ToolArm& arm, double seconds) {
    for (long k = std::lround(seconds / kStep); k > 0; --k)
      arm.step(motors_, JointVector::Zero(kToolJoints), kStep);
  }
  double radius(int joint) const { return robot_.drives[static_cast<std::size_t>(joint)].link_radius; }
};

TEST_F(ToolArmLaws, aPerfectArmFollowsItsTransmission) {
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  motors_ += JointVector::Constant(kToolJoints, 20.0);
  wait(arm, 1.0);
  const JointVector q = robot::Transmission(robot_).jointFromMotor(motors_);
  EXPECT_LT((arm.joints() - q).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((arm.pose().matrix() - robot::ToolKinematics(robot_).pose(q).matrix()).cwiseAbs().maxCoeff(),
            1e-6);
}

TEST_F(ToolArmLaws, aPulleyOfAnotherRadiusTurnsLess) {
  truth_.joints[kRoll].radius_share = 0.05;
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  const double before = arm.joints()[kRoll];
  pull(arm, kRoll, 2e-3, 0.01);
  wait(arm, 0.2);
  EXPECT_NEAR(arm.joints()[kRoll] - before, 2e-3 / (1.05 * radius(kRoll)), 1e-6);
}

TEST_F(ToolArmLaws, aRollTurnsTheWristWhoseCableHolds) {
  truth_.coupling_error(kWrist, kRoll) = 0.04;  // of 0.15 in the robot file
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  const JointVector before = arm.joints();
  pull(arm, kRoll, 2e-3, 0.01);
  wait(arm, 0.2);
  const JointVector change = arm.joints() - before;
  EXPECT_NEAR(change[kRoll], 0.25, 1e-6);                          // 2 mm over 8 mm
  EXPECT_NEAR(change[kWrist], -0.19 * 0.25, 1e-6);                 // travel 0 = 0.19 roll + wrist
  EXPECT_NEAR(change[5], -0.15 * 0.25 + 0.6 * 0.19 * 0.25, 1e-6);  // 0 = 0.15 roll + 0.6 wrist + jaw
  EXPECT_NEAR(change[6], 0.0, 1e-6);                               // both jaws alike
  EXPECT_NEAR(change.head<3>().norm(), 0.0, 1e-9);
}

TEST_F(ToolArmLaws, playIsPassedBeforeTheJointTurnsBack) {
  truth_.joints[kRoll].play = 1e-4;
  truth_.joints[kRoll].coulomb = 0.01;
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  const double start = arm.joints()[kRoll];
  pull(arm, kRoll, 1e-3, 0.005);
  wait(arm, 0.1);
  const double there = arm.joints()[kRoll];
  EXPECT_NEAR(there - start, (1e-3 - 1e-4) / radius(kRoll), 1e-5);  // half of the play was passed first
  pull(arm, kRoll, -1.9e-4, 0.005);
  wait(arm, 0.1);
  EXPECT_NEAR(arm.joints()[kRoll], there, 1e-6);
  pull(arm, kRoll, -1.1e-4, 0.005);
  wait(arm, 0.1);
  EXPECT_NEAR(arm.joints()[kRoll], there - 1e-4 / radius(kRoll), 1e-5);  // 3.0 less 2.0 tenths
}

TEST_F(ToolArmLaws, stretchDependsOnDirectionAndSpeed) {
  for (ToolJointTruth& joint : truth_.joints) joint.viscous = 1e-6;  // of what the roll's motion drags along
  ToolJointTruth& roll = truth_.joints[kRoll];
  roll.stiffness = 15e3, roll.coulomb = 0.015, roll.viscous = 0.01;
  const double r = radius(kRoll), k = roll.stiffness;
  for (const double speed : {0.002, 0.02})
    for (const double direction : {1.0, -1.0}) {
      ToolArm arm(robot_, truth_);
      motors_ << 200.0, -100.0, -300.0, 0.0, 0.0, 0.0, 0.0;
      arm.reset(motors_);
      const double start = arm.joints()[kRoll];
      pull(arm, kRoll, 4e-3 * direction, speed);
      // r k δ = F_c + F_v v while it moves, with v = speed / r
      const double stretch = (0.015 + 0.01 * speed / r) / (r * k);
      EXPECT_NEAR(arm.cableForce()[kRoll], direction * k * stretch, 1e-3 * k * stretch);
      EXPECT_NEAR(arm.joints()[kRoll] - start, direction * (4e-3 - stretch) / r, 2e-4);
      wait(arm, 0.5);  // what is viscous goes, what is dry stays: it remembers where it came from
      EXPECT_NEAR(arm.cableForce()[kRoll], direction * 0.015 / r, 0.02 * 0.015 / r);
    }
}

TEST_F(ToolArmLaws, gravityStretchesTheInsertionsCable) {
  robot_.gravity = {-9.81, 0.0, 0.0};
  truth_.joints[2].stiffness = 9e3;
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  wait(arm, 2.0);
  const robot::Chain chain(robot_);
  const Eigen::Vector3d axis = chain.linkPose(3, arm.joints()).linear().col(2);
  double mass = 0.0;
  for (std::size_t i = 2; i < kToolJoints; ++i) mass += robot_.joints[i].link.mass;
  // Weight along the axis = pull of all cables that run along the insertion.
  double pull = 0.0;
  for (int i = 2; i < kToolJoints; ++i)
    pull += robot_.drives[static_cast<std::size_t>(i)].link_radius *
            robot_.coupling[static_cast<std::size_t>(i)][2] * arm.cableForce()[i];
  EXPECT_NEAR(pull, -mass * robot_.gravity.dot(axis), 1e-3);
}

TEST_F(ToolArmLaws, eccentricCapstansAddASine) {
  truth_.joints[kRoll].eccentricity = 1e-4;
  ToolArm arm(robot_, truth_);
  arm.reset(motors_);
  const double start = arm.joints()[kRoll];
  pull(arm, kRoll, 2e-3, 0.01);
  wait(arm, 0.2);
  const double phi = 2e-3 / 5.675e-3;  // of the capstan
  EXPECT_NEAR(arm.joints()[kRoll] - start, (2e-3 + 1e-4 * std::sin(phi)) / radius(kRoll), 1e-6);
}

TEST_F(ToolArmLaws, theSameStepsGiveTheSameBytes) {
  truth_ = readToolTruth(base::resource("truth/debridement.yaml"));
  const auto end = [&] {
    ToolArm arm(robot_, truth_);
    motors_ << 200.0, -100.0, -300.0, 0.0, 0.0, 0.0, 0.0;
    arm.reset(motors_);
    pull(arm, 0, 5e-3, 0.01);
    return arm.joints();
  };
  EXPECT_EQ(end(), end());
}

TEST(QuasiStatic, hasItsClosedForms) {
  EXPECT_EQ(forceBeyondPlay(1e-4, 2e-4, 1e4), 0.0);
  EXPECT_DOUBLE_EQ(forceBeyondPlay(-5e-4, 2e-4, 1e4), -3.0);
  EXPECT_DOUBLE_EQ(breakaway(2.0, 0.5, 0.1, 0.0), 3.0);
  EXPECT_DOUBLE_EQ(breakaway(2.0, 0.5, 0.1, 0.1), 2.0 * (1.0 + 0.5 / std::exp(1.0)));
  EXPECT_EQ(moved(0.9, 1.0, 10.0, 1.0, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(moved(-3.0, 1.0, 10.0, 1.0, 0.1), -0.1);  // (3 − 1) / (10 + 10)
}

TEST(ToolTruth, refusesOtherRobotsAndWrongFiles) {
  const auto other = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  EXPECT_THROW(ToolArm(other, {}), base::InputError);
  EXPECT_THROW(readToolTruth(base::resource("truth/default.yaml")), base::InputError);
}

}  // namespace
}  // namespace capstan::simulation
