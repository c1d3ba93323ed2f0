#include "core/simulation/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/base/error.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

/// The velocity of every trajectory is the derivative of its position.
void expectConsistentVelocity(const Trajectory& trajectory) {
  constexpr double kStep = 1e-5;
  for (double t = 0.0137; t < trajectory.duration(); t += 0.0731) {
    const Eigen::Vector3d slope =
        (trajectory.at(t + kStep).position - trajectory.at(t - kStep).position) / (2.0 * kStep);
    EXPECT_LT((slope - trajectory.at(t).velocity).cwiseAbs().maxCoeff(), 2e-5) << "t = " << t;
  }
}

std::filesystem::path writeTable(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
  std::ofstream(path) << text;
  return path;
}

TEST(MinimumJerk, StartsAndEndsAtRestAndPeaksAtFifteenEighths) {
  EXPECT_EQ(minimumJerk(-1.0, 2.0), (std::pair{0.0, 0.0}));
  EXPECT_EQ(minimumJerk(2.0, 2.0), (std::pair{1.0, 0.0}));
  EXPECT_DOUBLE_EQ(minimumJerk(1.0, 2.0).first, 0.5);
  EXPECT_DOUBLE_EQ(minimumJerk(1.0, 2.0).second, 1.875 / 2.0);  // Flash and Hogan: peak 15/8 of the mean
}

TEST(Trajectories, VelocitiesAreDerivatives) {
  TrajectorySpec spec;
  spec.duration = 20.0;
  for (const TrajectoryKind kind : {TrajectoryKind::kHold, TrajectoryKind::kSinusoid,
                                    TrajectoryKind::kBlockTransfer, TrajectoryKind::kHardStop}) {
    SCOPED_TRACE(base::nameOf(kind));
    spec.kind = kind;
    expectConsistentVelocity(*makeTrajectory(spec, raven(), 5));
  }
}

TEST(Sinusoid, IsTheFormulaAwayFromItsEnds) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kSinusoid;
  spec.duration = 30.0;
  const auto trajectory = makeTrajectory(spec, raven(), 1);
  const double t = 11.3;
  const JointTarget target = trajectory->at(t);
  for (int i = 0; i < 3; ++i) {
    const double omega = 2.0 * std::numbers::pi * spec.sinusoid.frequency[i];
    EXPECT_NEAR(target.position[i],
                spec.sinusoid.centre[i] + spec.sinusoid.amplitude[i] * std::sin(omega * t), 1e-12);
    EXPECT_NEAR(target.velocity[i], omega * spec.sinusoid.amplitude[i] * std::cos(omega * t), 1e-12);
  }
  EXPECT_LT((trajectory->at(0.0).position - spec.sinusoid.centre).norm(), 1e-12);
  EXPECT_LT(trajectory->at(30.0).velocity.norm(), 1e-12);
}

TEST(Sinusoid, OutsideTheLimitsIsRefusedByName) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kSinusoid;
  spec.sinusoid.amplitude[1] = 1.2;
  try {
    makeTrajectory(spec, raven(), 1);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "sinusoid, joint 2");
    EXPECT_NE(std::string(error.what()).find("outside"), std::string::npos);
  }
  spec.sinusoid = {};
  spec.sinusoid.frequency[2] = 4.0;
  EXPECT_THROW(makeTrajectory(spec, raven(), 1), base::InputError);
}

/// How many instants a check of the whole movement looks at.
std::int64_t instants(const Trajectory& trajectory) {
  std::int64_t count = 0;
  for (double t = 0.0; t < trajectory.duration(); t = trajectory.nextInstant(t)) ++count;
  return count;
}

TEST(Trajectories, ADayIsCheckedAtFewInstantsAndAMinuteAtMany) {
  TrajectorySpec spec;
  for (const TrajectoryKind kind : {TrajectoryKind::kSinusoid, TrajectoryKind::kBlockTransfer}) {
    SCOPED_TRACE(base::nameOf(kind));
    spec.kind = kind;
    spec.duration = 60.0;
    EXPECT_GE(instants(*makeTrajectory(spec, raven(), 5)), 12000);
    spec.duration = 86400.0;
    EXPECT_LT(instants(*makeTrajectory(spec, raven(), 5)), 1'500'000);
    EXPECT_GT(instants(*makeTrajectory(spec, raven(), 5)), 300'000);
  }
}

TEST(Trajectories, ADayThatIsTooFastOrTooFarIsRefused) {
  TrajectorySpec spec;
  spec.duration = 86400.0;
  spec.kind = TrajectoryKind::kSinusoid;
  spec.sinusoid.amplitude[1] = 1.2;
  EXPECT_THROW(makeTrajectory(spec, raven(), 1), base::InputError);
  spec.sinusoid = {};
  spec.sinusoid.frequency[2] = 4.0;
  EXPECT_THROW(makeTrajectory(spec, raven(), 1), base::InputError);
  spec.kind = TrajectoryKind::kBlockTransfer;
  robot::Description slow = raven();
  for (auto& joint : slow.joints) joint.max_speed *= 0.1;
  EXPECT_THROW(makeTrajectory(spec, slow, 1), base::InputError);
}

TEST(HardStop, GoesThereRestsAndReturns) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kHardStop;
  const robot::Description robot = raven();
  const auto trajectory = makeTrajectory(spec, robot, 1);
  EXPECT_EQ(trajectory->at(0.0).position, spec.hard_stop.start);
  EXPECT_LT((trajectory->at(0.5 * trajectory->duration()).position - robot::homingOf(robot)).norm(), 1e-12);
  EXPECT_LT(trajectory->at(0.5 * trajectory->duration()).velocity.norm(), 1e-12);
  EXPECT_LT((trajectory->at(trajectory->duration()).position - spec.hard_stop.start).norm(), 1e-12);
}

TEST(Recorded, PassesThroughEveryRowAndIsSmoothBetween) {
  std::string text = "t,q1,q2,q3,remark\n";
  for (int i = 0; i <= 40; ++i) {
    const double t = 2.0 + 0.05 * i;
    text += std::to_string(t) + "," + std::to_string(0.6 + 0.2 * std::sin(t)) + "," +
            std::to_string(1.5 + 0.1 * std::cos(t)) + "," + std::to_string(0.32 + 0.02 * std::sin(2.0 * t)) +
            ",\n";
  }
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kRecorded;
  spec.recorded.file = writeTable("capstan_recorded_trajectory.csv", text).string();
  const auto trajectory = makeTrajectory(spec, raven(), 1);
  EXPECT_NEAR(trajectory->duration(), 2.0, 1e-9);
  expectConsistentVelocity(*trajectory);
  for (double t = 0.1; t < 1.9; t += 0.013) {  // the curve that was sampled; rows hold six decimals
    const double s = t + 2.0;
    const Eigen::Vector3d truth(0.6 + 0.2 * std::sin(s), 1.5 + 0.1 * std::cos(s),
                                0.32 + 0.02 * std::sin(2.0 * s));
    EXPECT_LT((trajectory->at(t).position - truth).cwiseAbs().maxCoeff(), 5e-6);
  }
  std::filesystem::remove(spec.recorded.file);
}

TEST(Recorded, UnusableTablesAreRefused) {
  TrajectorySpec spec;
  spec.kind = TrajectoryKind::kRecorded;
  for (const char* text :
       {"t,q1,q2\n0,0.5,1.5\n1,0.5,1.5\n", "t,q1,q2,q3\n0,0.5,1.5,0.3\n",
        "t,q1,q2,q3\n0,0.5,1.5,0.3\n1,,1.5,0.3\n", "t,q1,q2,q3\n0,0.5,1.5,0.3\n1,0.5,1.5,0.9\n"}) {
    spec.recorded.file = writeTable("capstan_recorded_bad.csv", text).string();
    EXPECT_THROW(makeTrajectory(spec, raven(), 1), base::InputError) << text;
  }
  std::filesystem::remove(spec.recorded.file);
  spec.recorded.file = "/nowhere/there_is_no_table.csv";
  EXPECT_THROW(makeTrajectory(spec, raven(), 1), base::InputError);
}

}  // namespace
}  // namespace capstan::simulation
