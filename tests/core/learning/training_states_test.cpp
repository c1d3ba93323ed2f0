// What other trajectories tell counts, what cleaning took of it, too; what they contradict counts little.
#include "core/learning/poses/training_states.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/learning/model/trial_model.h"
#include "core/stats/rms.h"
#include "tests/core/learning/quick_options.h"

namespace capstan::learning {
namespace {

struct RandomizedRobot {
  double stuck_beyond = 1.0;  ///< x from which the wrist stays behind its command [m]
  double jumps = 0.0;         ///< share of observations that are somewhere else
};

/// Motions of 40 states each through a box of 10 cm. Beyond `stuck_beyond` the tool is turned by up to 80°
/// from what it was told, the same in each motion.
std::vector<State> states(const RandomizedRobot& world, std::size_t motions) {
  base::Random random(8, "states");
  std::vector<State> made;
  for (std::size_t m = 0; m < motions; ++m)
    for (int k = 0; k < 40; ++k) {
      State state;
      state.motion = m;
      state.t = 0.1 * k;
      const Eigen::Vector3d at(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05),
                               random.uniform(-0.05, 0.05));
      state.pair.commanded.translation() = at;
      state.pair.observed.translation() = at + Eigen::Vector3d(random.normal(0.0, 2e-4), 0.0, 1e-3);
      const double behind = std::clamp((at.x() - world.stuck_beyond) / 0.01, 0.0, 1.0) * 1.4;
      state.pair.observed.linear() =
          Eigen::AngleAxisd(behind + random.normal(0.0, 2e-3), Eigen::Vector3d::UnitX()).matrix();
      if (random.uniform(0.0, 1.0) < world.jumps)
        state.pair.observed.translation() += Eigen::Vector3d(random.uniform(-0.05, 0.05), 0.04, -0.03);
      made.push_back(state);
    }
  return made;
}

TrainingStates weighed(const std::vector<State>& all, base::Progress* progress = nullptr) {
  TrainingStates training = trainingStates(all, cleanStates(all));
  weigh(training, all, quickOptions(), progress);
  return training;
}

/// Root of the mean extra variance of a motion's states [m, rad].
Vector6d doubtOf(const TrainingStates& training, std::size_t motion) {
  Vector6d sum = Vector6d::Zero();
  double count = 0.0;
  for (const State& state : training.states)
    if (state.motion == motion) sum += state.extra_variance, ++count;
  return (sum / count).cwiseSqrt();
}

TEST(Weigh, WhatIsOutOfPlaceInTheSameWayEachTimeCounts) {
  const std::vector<State> all = states({.stuck_beyond = 0.02}, 22);
  const TrainingStates before = trainingStates(all, cleanStates(all)), after = weighed(all);
  const std::size_t taken = all.size() - before.states.size();
  ASSERT_GT(taken, 150U);
  EXPECT_GT(after.weighing.again.size(), taken / 2);
  EXPECT_EQ(after.states.size(), before.states.size() + after.weighing.again.size());
  EXPECT_EQ(after.cleaning.kept(), after.states.size());
  EXPECT_TRUE(after.offset.isApprox(before.offset)) << "of those that cleaning kept";
}

TEST(Weigh, WhatIsWrongByChanceDoesNot) {
  const std::vector<State> all = states({.jumps = 0.15}, 30);
  const TrainingStates after = weighed(all);
  const std::size_t taken = all.size() - cleanStates(all).kept();
  ASSERT_GT(taken, 150U);
  EXPECT_LE(after.weighing.again.size(), taken / 20);
}

/// A speed that the robot does not have says that the velocity is wrong, which a pose does not.
TEST(Weigh, NorWhatMovesTooFast) {
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (std::size_t k = 0; k < all.size(); k += 7) all[k].velocity[0] = 1.0;
  const TrainingStates after = weighed(all);
  EXPECT_FALSE(after.weighing.again.empty());
  EXPECT_TRUE(
      std::ranges::none_of(after.states, [](const State& state) { return state.velocity[0] == 1.0; }));
}

/// So little that cleaning keeps it.
TEST(Weigh, ATrajectoryThatIsALittleOffCountsLess) {
  std::vector<State> all = states({}, 30);
  for (State& state : all)
    if (state.motion == 4) state.pair.observed.translation().y() += 4e-4;
  ASSERT_EQ(cleanStates(all).kept(), all.size());
  const TrainingStates after = weighed(all);
  EXPECT_LT(doubtOf(after, 5).y(), 5e-5);
  EXPECT_GT(doubtOf(after, 4).y(), 3.0 * doubtOf(after, 5).y());
}

/// Along the axes that positions are told in, however the tool is turned, as outputs are that get exclusions.
TEST(LeftOf, IsInTheFrameOfTheCorrection) {
  std::vector<State> all = states({}, 2);
  for (State& state : all) {
    state.pair.observed.linear() = Eigen::AngleAxisd(1.5, Eigen::Vector3d(0.0, 0.6, 0.8)).matrix();
    state.pair.commanded = state.pair.observed;
  }
  const CorrectionModel rigid = CorrectionModel::rigid(all);
  all[3].pair.commanded.translation().y() += 1e-3;
  all[5].pair.commanded.rotate(Eigen::AngleAxisd(2e-3, Eigen::Vector3d::UnitX()));
  const std::vector<Vector6d> left = leftOf(rigid, all);
  EXPECT_LT((left[3] - 1e-3 * Vector6d::Unit(1)).norm(), 1e-9);
  EXPECT_LT((left[5] - 2e-3 * Vector6d::Unit(3)).norm(), 1e-9);
  EXPECT_LT(left[4].norm(), 1e-9);
}

/// In y, where those that are off are, and seen without noise.
double leftInY(const std::vector<State>& learned, const std::vector<State>& truth) {
  const auto corrected = CorrectionModel::trained(learned, quickOptions()).correct(truth);
  double sum = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    sum += std::abs((corrected[k].translation() - truth[k].pair.commanded.translation()).y());
  return sum / static_cast<double>(truth.size());
}

/// Some motions tell another function than most.
TEST(Weigh, AModelOfWeighedStatesIsNearer) {
  const std::vector<State> truth = states({}, 30);
  std::vector<State> all = truth;
  for (State& state : all)
    if (state.motion % 6 == 4)
      state.pair.observed.translation().y() +=
          5e-4 * std::sin(100.0 * state.pair.commanded.translation().x());
  ASSERT_EQ(cleanStates(all).kept(), all.size());
  const std::vector<State> states = weighed(all).states;
  EXPECT_EQ(states.size(), all.size());
  EXPECT_LT(leftInY(states, truth), 0.8 * leftInY(all, truth));
}

TEST(Weigh, NothingWhereMotionsAreTooFewOrWorkIsCancelled) {
  const auto untouched = [](const TrainingStates& training) {
    return training.weighing.again.empty() && !training.weighing.weighed &&
           std::ranges::all_of(training.states,
                               [](const State& state) { return state.extra_variance.isZero(); });
  };
  EXPECT_TRUE(untouched(weighed(states({.stuck_beyond = 0.02}, 9))));
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(untouched(weighed(states({.stuck_beyond = 0.02}, 30), &progress)));
}

}  // namespace
}  // namespace capstan::learning
