// What other trajectories tell counts, what cleaning took of it, too; what they contradict counts little.
#include "core/learning/training_states.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/learning/trial_model.h"
#include "core/stats/rms.h"
#include "tests/core/learning/quick_options.h"

namespace capstan::learning {
namespace {

struct World {
  double stuck_beyond = 1.0;  ///< x from which the wrist stays behind its command [m]
  double jumps = 0.0;         ///< share of sights that are somewhere else
};

/// Motions of 40 states each through a box of 10 cm. Beyond `stuck_beyond` the tool is turned by up to 80°
/// from what it was told, the same in each motion.
std::vector<State> states(const World& world, std::size_t motions) {
  base::Random random(8, "states");
  std::vector<State> made;
  for (std::size_t m = 0; m < motions; ++m)
    for (int k = 0; k < 40; ++k) {
      State state;
      state.motion = m;
      state.t = 0.1 * k;
      const Eigen::Vector3d at(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05),
                               random.uniform(-0.05, 0.05));
      state.pair.told.translation() = at;
      state.pair.seen.translation() = at + Eigen::Vector3d(random.normal(0.0, 2e-4), 0.0, 1e-3);
      const double behind = std::clamp((at.x() - world.stuck_beyond) / 0.01, 0.0, 1.0) * 1.4;
      state.pair.seen.linear() =
          Eigen::AngleAxisd(behind + random.normal(0.0, 2e-3), Eigen::Vector3d::UnitX()).matrix();
      if (random.uniform(0.0, 1.0) < world.jumps)
        state.pair.seen.translation() += Eigen::Vector3d(random.uniform(-0.05, 0.05), 0.04, -0.03);
      made.push_back(state);
    }
  return made;
}

TrainingStates weighed(const std::vector<State>& all, base::Progress* progress = nullptr) {
  TrainingStates training = trainingStates(all, cleanStates(all), kLever);
  weigh(training, all, quickOptions(), progress);
  return training;
}

double weightOf(const TrainingStates& training, std::size_t motion) {
  double weight = 0.0;
  for (const State& state : training.states)
    if (state.motion == motion) weight += state.weight;
  return weight;
}

TEST(Weigh, WhatIsOutOfPlaceInTheSameWayEachTimeCounts) {
  const std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  const TrainingStates before = trainingStates(all, cleanStates(all), kLever), after = weighed(all);
  const std::size_t taken = all.size() - before.states.size();
  ASSERT_GT(taken, 200U);
  EXPECT_GT(after.cleaning.readmitted.size(), taken / 2);
  EXPECT_EQ(after.states.size(), before.states.size() + after.cleaning.readmitted.size());
  EXPECT_EQ(after.cleaning.kept(), after.states.size());
  EXPECT_TRUE(after.offset.isApprox(before.offset)) << "of those that cleaning kept";
}

TEST(Weigh, WhatIsWrongByChanceDoesNot) {
  const std::vector<State> all = states({.jumps = 0.15}, 30);
  const TrainingStates after = weighed(all);
  const std::size_t taken = all.size() - cleanStates(all).kept();
  ASSERT_GT(taken, 100U);
  EXPECT_LE(after.cleaning.readmitted.size(), taken / 20);
}

/// A speed that the robot does not have says that the velocity is wrong, which a pose does not.
TEST(Weigh, NorWhatMovesTooFast) {
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (std::size_t k = 0; k < all.size(); k += 7) all[k].velocity[0] = 1.0;
  const TrainingStates after = weighed(all);
  EXPECT_FALSE(after.cleaning.readmitted.empty());
  EXPECT_EQ(std::ranges::count(after.cleaning.readmitted, Reason::kTooFast), 0);
  EXPECT_EQ(after.cleaning.count(Reason::kTooFast), cleanStates(all).count(Reason::kTooFast));
}

TEST(Weigh, ATrajectoryThatIsALittleOffCountsLittle) {
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (State& state : all)
    if (state.motion == 4) state.pair.seen.translation().y() += 1.5e-3;
  const TrainingStates after = weighed(all);
  EXPECT_GT(weightOf(after, 5), 20.0) << "40 states";
  EXPECT_LT(weightOf(after, 4), 0.25 * weightOf(after, 5));
}

TEST(Weigh, AModelOfWeighedStatesIsNearer) {
  const std::vector<State> truth = states({.stuck_beyond = 0.02}, 30);
  std::vector<State> all = truth;
  for (State& state : all)
    if (state.motion % 6 == 4) state.pair.seen.translation().y() += state.motion % 12 == 4 ? 5e-3 : -5e-3;
  const TrainingStates plain = trainingStates(all, cleanStates(all), kLever), after = weighed(all);
  const auto left = [&](const TrainingStates& training) {
    return stats::mean(leftOf(CorrectionModel::trained(training.states, quickOptions()), truth, kLever));
  };
  EXPECT_LT(left(after), 0.8 * left(plain));
}

TEST(Weigh, NothingWhereMotionsAreTooFewOrWorkIsCancelled) {
  const auto untouched = [](const TrainingStates& training) {
    return training.cleaning.readmitted.empty() &&
           std::ranges::all_of(training.states, [](const State& state) { return state.weight == 1.0; });
  };
  EXPECT_TRUE(untouched(weighed(states({.stuck_beyond = 0.02}, 9))));
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(untouched(weighed(states({.stuck_beyond = 0.02}, 30), &progress)));
}

}  // namespace
}  // namespace capstan::learning
