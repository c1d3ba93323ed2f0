#include "core/simulation/block_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

std::unique_ptr<Trajectory> surgeon(std::uint64_t seed, double duration, const std::string& side = "left") {
  TrajectorySpec spec;
  spec.duration = duration;
  return makeTrajectory(spec, raven(side), seed);
}

TEST(BlockTransfer, TwentySurgeonsStayInsideLimitsSpeedsAndAwayFromTheRemoteCentre) {
  const robot::Description robot = raven();
  const robot::ArmKinematics kinematics(robot);
  double nearest = 1.0, fastest = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double duration = seed % 3 == 0 ? 290.0 : seed % 3 == 1 ? 80.0 : 188.0;
    const auto trajectory = surgeon(seed, duration);
    Eigen::Vector3d last = kinematics.tip(trajectory->at(0.0).position);
    for (double t = 0.0; t <= duration; t += 0.02) {
      const JointTarget target = trajectory->at(t);
      for (int i = 0; i < 3; ++i) {
        const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
        ASSERT_GT(target.position[i], joint.limit_low);
        ASSERT_LT(target.position[i], joint.limit_high);
        ASSERT_LT(std::abs(target.velocity[i]), joint.max_speed);
      }
      const Eigen::Vector3d tip = kinematics.tip(target.position);
      nearest = std::min(nearest, tip.norm());
      fastest = std::max(fastest, (tip - last).norm() / 0.02);
      last = tip;
    }
  }
  EXPECT_GT(nearest, 0.08);  // [m]
  EXPECT_LT(fastest, 0.35);  // [m/s]
  EXPECT_GT(fastest, 0.10);
  RecordProperty("nearest_to_remote_centre_mm", std::to_string(1e3 * nearest));
  RecordProperty("fastest_tip_mm_s", std::to_string(1e3 * fastest));
}

TEST(BlockTransfer, TheRightArmDoesItToo) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) EXPECT_NO_THROW(surgeon(seed, 80.0, "right"));
}

TEST(BlockTransfer, EveryBlockGoesToTheOtherSideAndBack) {
  const robot::Description robot = raven();
  const PegBoard board = pegBoard(robot);
  const BlockTransfer task({.tremor = 0.0}, 120.0, robot, 3);
  EXPECT_EQ(task.transfers(), 12);
  std::vector<int> visits;  // pegs in the order in which the tip came down on them
  for (double t = 0.0; t <= 120.0; t += 0.005) {
    const Eigen::Vector3d tip = task.tipAt(t).first;
    for (int peg = 0; peg < 12; ++peg) {
      const Eigen::Vector3d away = tip - board.peg(peg);
      const double height = away.dot(board.up), aside = (away - height * board.up).norm();
      if (height < 0.012 && aside < 0.006 && (visits.empty() || visits.back() != peg)) visits.push_back(peg);
    }
  }
  ASSERT_EQ(visits.size(), 24U);
  for (std::size_t i = 0; i < visits.size(); i += 2) {
    const bool outward = i < 12;
    EXPECT_EQ(visits[i] < 6, outward) << "pick " << i;
    EXPECT_EQ(visits[i + 1] < 6, !outward) << "place " << i;
  }
  for (const auto from : {0, 12}) {  // six different pegs each time
    std::vector<int> round(visits.begin() + from, visits.begin() + from + 12);
    std::sort(round.begin(), round.end());
    EXPECT_EQ(std::unique(round.begin(), round.end()) - round.begin(), 12);
  }
}

TEST(BlockTransfer, SeedsAreSurgeons) {
  const auto one = surgeon(1, 100.0), again = surgeon(1, 100.0), other = surgeon(2, 100.0);
  double apart = 0.0;
  for (double t = 0.0; t <= 100.0; t += 0.5) {
    EXPECT_EQ(one->at(t).position, again->at(t).position);
    apart = std::max(apart, (one->at(t).position - other->at(t).position).norm());
  }
  EXPECT_GT(apart, 0.1);
}

TEST(BlockTransfer, RestsAtBothEndsAndShakesBetween) {
  const robot::Description robot = raven();
  const BlockTransfer still({.tremor = 0.0}, 90.0, robot, 4), shaky({.tremor = 3e-4}, 90.0, robot, 4);
  EXPECT_LT(shaky.tipAt(0.0).second.norm(), 1e-12);
  EXPECT_LT(shaky.tipAt(90.0).second.norm(), 1e-12);
  double largest = 0.0;
  for (double t = 2.0; t < 88.0; t += 0.01)
    largest = std::max(largest, (shaky.tipAt(t).first - still.tipAt(t).first).cwiseAbs().maxCoeff());
  EXPECT_GT(largest, 2e-4);
  EXPECT_LT(largest, 6e-4);  // three tones of at most 0.6 amplitudes, never all in phase
}

TEST(BlockTransfer, PausesTakeTheirShareOfTheTime) {
  const robot::Description robot = raven();
  for (const double share : {0.1, 0.4}) {
    const BlockTransfer task({.tremor = 0.0, .pause_share = share}, 200.0, robot, 6);
    int still = 0, all = 0;
    for (double t = 0.0; t < 200.0; t += 0.01, ++all) still += task.tipAt(t).second.norm() < 1e-9 ? 1 : 0;
    EXPECT_NEAR(static_cast<double>(still) / all, share, 0.01);
  }
}

TEST(BlockTransfer, DurationChoosesHowMuchIsDone) {
  const robot::Description robot = raven();
  EXPECT_EQ(BlockTransfer({}, 80.0, robot, 1).transfers(), 12);
  EXPECT_EQ(BlockTransfer({}, 290.0, robot, 1).transfers(), 12);
  EXPECT_EQ(BlockTransfer({}, 20.0, robot, 1).transfers(), 3);
  EXPECT_EQ(BlockTransfer({}, 400.0, robot, 1).transfers(), 24);
}

}  // namespace
}  // namespace capstan::simulation
