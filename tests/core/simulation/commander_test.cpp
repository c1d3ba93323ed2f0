#include "core/simulation/commander.h"

#include <gtest/gtest.h>

#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

constexpr double kTick = 1e-3;

class CommanderTest : public testing::Test {
 protected:
  CommanderTest() : trajectory_(make()), commander_(*trajectory_, kStop) {}

  static std::unique_ptr<Trajectory> make() {
    TrajectorySpec spec;
    spec.kind = TrajectoryKind::kSinusoid;
    spec.duration = 10.0;
    return makeTrajectory(spec, raven(), 1);
  }

  /// Runs and checks that position moves as velocity says, without a jump.
  void run(double seconds) {
    for (double t = 0.0; t < seconds; t += kTick) {
      const JointTarget before = commander_.target(), after = commander_.step(kTick);
      const Eigen::Vector3d mean = 0.5 * kTick * (before.velocity + after.velocity);
      ASSERT_LT((after.position - before.position - mean).cwiseAbs().maxCoeff(), 3e-6);
    }
  }

  inline static const Eigen::Vector3d kStop{0.0, 2.4, 0.562};
  std::unique_ptr<Trajectory> trajectory_;
  Commander commander_;
};

TEST_F(CommanderTest, RunsThePathToItsEnd) {
  run(5.0);
  EXPECT_NEAR(commander_.pathTime(), 4.75, 0.01);  // a quarter second went into getting up to pace
  EXPECT_FALSE(commander_.finished());
  run(5.5);
  EXPECT_TRUE(commander_.finished());
}

TEST_F(CommanderTest, HoldsOnThePathAndGoesOn) {
  run(3.0);
  commander_.command(MotionCommand::kHold);
  run(1.0);
  const double held = commander_.pathTime();
  EXPECT_LT(commander_.target().velocity.norm(), 1e-12);
  EXPECT_EQ(commander_.target().position, trajectory_->at(held).position);
  run(1.0);
  EXPECT_EQ(commander_.pathTime(), held);
  commander_.command(MotionCommand::kRun);
  run(2.0);
  EXPECT_NEAR(commander_.pathTime(), held + 1.75, 0.01);
}

TEST_F(CommanderTest, FollowsAnotherMotionAndReturnsToThePath) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kSinusoid;
  spec.duration = 6.0;
  spec.sinusoid.centre = {0.9, 1.4, 0.40};
  spec.sinusoid.amplitude = {0.1, 0.1, 0.01};
  spec.sinusoid.frequency = {0.8, 0.9, 1.0};
  const std::shared_ptr<const Trajectory> motion = makeTrajectory(spec, raven(), 1);
  run(2.0);
  commander_.setMotion(motion);
  commander_.command(MotionCommand::kMotion);
  run(1.0);
  const double left = commander_.pathTime();
  double away = 0.0;
  for (int i = 0; i < 12000 && !commander_.motionDone(); ++i) {
    commander_.step(kTick);
    away = std::max(away, (commander_.target().position - spec.sinusoid.centre).norm());
  }
  ASSERT_TRUE(commander_.motionDone());
  EXPECT_EQ(commander_.pathTime(), left);
  EXPECT_GT(away, 0.1);
  commander_.command(MotionCommand::kRun);
  EXPECT_FALSE(commander_.motionDone());
  run(4.0);
  EXPECT_GT(commander_.pathTime(), left) << "back on the path";
}

TEST_F(CommanderTest, ANewMotionOrCommandEndsOneWithoutAJump) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kSinusoid;
  spec.duration = 20.0;
  spec.sinusoid.centre = {0.9, 1.4, 0.40};
  const std::shared_ptr<const Trajectory> first = makeTrajectory(spec, raven(), 1);
  spec.sinusoid.centre = {0.5, 1.7, 0.35};
  const std::shared_ptr<const Trajectory> second = makeTrajectory(spec, raven(), 1);
  commander_.setMotion(first);
  commander_.command(MotionCommand::kMotion);
  run(8.0);
  commander_.setMotion(second);
  run(4.0);
  EXPECT_LT((commander_.target().position - spec.sinusoid.centre).cwiseAbs().maxCoeff(), 0.5);
  commander_.command(MotionCommand::kHardStop);
  run(12.0);
  EXPECT_TRUE(commander_.atHardStop());
}

TEST_F(CommanderTest, DrivesToTheHardStopWaitsAndReturns) {
  run(2.0);
  commander_.command(MotionCommand::kHardStop);
  EXPECT_FALSE(commander_.atHardStop());
  run(10.0);
  EXPECT_TRUE(commander_.atHardStop());
  EXPECT_FALSE(commander_.finished());
  EXPECT_LT((commander_.target().position - kStop).norm(), 1e-12);
  const double left = commander_.pathTime();
  commander_.command(MotionCommand::kRun);
  run(0.1);
  EXPECT_FALSE(commander_.atHardStop());
  run(10.0);
  EXPECT_GT(commander_.pathTime(), left);
  run(10.0);
  EXPECT_TRUE(commander_.finished());
}

TEST_F(CommanderTest, ACommandOnTheWayIsObeyedAfterArrival) {
  commander_.command(MotionCommand::kHardStop);
  run(1.5);
  commander_.command(MotionCommand::kHold);
  run(20.0);
  EXPECT_FALSE(commander_.atHardStop());
  EXPECT_EQ(commander_.target().position, trajectory_->at(commander_.pathTime()).position);
}

}  // namespace
}  // namespace capstan::simulation
