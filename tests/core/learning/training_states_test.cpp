// What cleaning takes and can be learned is kept again; what is wrong by chance is not.
#include "core/learning/training_states.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
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

TrainingStates readmittedOf(const std::vector<State>& all, const CleaningOptions& limits = {},
                            base::Progress* progress = nullptr) {
  TrainingStates training = trainingStates(all, cleanStates(all, limits), kLever);
  readmit(training, all, limits, quickOptions(), progress);
  return training;
}

TEST(Readmit, WhatIsOutOfPlaceInTheSameWayEachTime) {
  const std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  const TrainingStates before = trainingStates(all, cleanStates(all), kLever), after = readmittedOf(all);
  const std::size_t taken = all.size() - before.states.size();
  ASSERT_GT(taken, 200U);
  EXPECT_GT(after.cleaning.readmitted.size(), taken / 2);
  EXPECT_EQ(after.states.size(), before.states.size() + after.cleaning.readmitted.size());
  EXPECT_TRUE(after.offset.isApprox(before.offset)) << "of those that cleaning kept";
}

/// Sights that are wrong by chance are at times where a model that learned them all, too, has its mean:
/// models that learn those are worse for the others.
TEST(Readmit, NotWhatIsWrongByChance) {
  const std::vector<State> all = states({.jumps = 0.15}, 30);
  const TrainingStates after = readmittedOf(all);
  const std::size_t taken = all.size() - cleanStates(all).kept();
  ASSERT_GT(taken, 100U);
  EXPECT_LE(after.cleaning.readmitted.size(), taken / 20);
}

/// A speed that the robot does not have says that the velocity is wrong, which a pose does not.
TEST(Readmit, NotWhatMovesTooFast) {
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (std::size_t k = 0; k < all.size(); k += 7) all[k].velocity[0] = 1.0;
  const TrainingStates after = readmittedOf(all);
  EXPECT_FALSE(after.cleaning.readmitted.empty());
  EXPECT_EQ(std::ranges::count(after.cleaning.readmitted, Reason::kTooFast), 0);
  EXPECT_EQ(after.cleaning.count(Reason::kTooFast), cleanStates(all).count(Reason::kTooFast));
}

/// Of a trajectory that goes as a whole some states pass by chance: they stay out with it.
TEST(Readmit, TrajectoriesAsAWholeOrNotAtAll) {
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (State& state : all) {
    auto at = state.pair.seen.translation();
    if (state.motion == 4) std::swap(at.x(), at.y());
  }
  const TrainingStates after = readmittedOf(all, {.most_rejected = 0.4});
  EXPECT_FALSE(after.cleaning.readmitted.empty());
  EXPECT_GT(after.cleaning.count(Reason::kTrajectory), 0U);
  EXPECT_TRUE(std::ranges::none_of(after.states, [](const State& state) { return state.motion == 4; }));
}

/// So do those of one that is out of place throughout, some of it in the same way each time.
TEST(Readmit, TrajectoriesOutOfPlaceThroughoutLikewise) {
  const CleaningOptions limits{.most_rejected = 0.8};
  std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  for (State& state : all)
    if (state.motion == 4 && state.pair.told.translation().x() < 0.035)
      state.pair.seen.translation().y() += 0.5;
  const CleaningReport cleaned = cleanStates(all, limits);
  for (std::size_t k = 0; k < all.size(); ++k)
    ASSERT_TRUE(all[k].motion != 4 || misplaced(cleaned.reason[k]));
  const TrainingStates after = readmittedOf(all, limits);
  EXPECT_FALSE(after.cleaning.readmitted.empty());
  EXPECT_TRUE(std::ranges::none_of(after.states, [](const State& state) { return state.motion == 4; }));
}

TEST(Readmit, NothingWhereMotionsAreTooFewOrWorkIsCancelled) {
  EXPECT_TRUE(readmittedOf(states({.stuck_beyond = 0.02}, 9)).cleaning.readmitted.empty());
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(readmittedOf(states({.stuck_beyond = 0.02}, 30), {}, &progress).cleaning.readmitted.empty());
}

}  // namespace
}  // namespace capstan::learning
