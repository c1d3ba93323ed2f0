// What cleaning takes and can be learned is kept again; what is wrong by chance is not.
#include "core/learning/readmit_states.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

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

CorrectionOptions quick() {
  CorrectionOptions options;
  options.likelihood_points = 250;
  options.inducing_points = 250;
  return options;
}

TEST(Readmit, WhatIsOutOfPlaceInTheSameWayEachTime) {
  const std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  const CleaningReport cleaned = cleanStates(all), more = readmit(all, cleaned, quick());
  const std::size_t taken = all.size() - cleaned.kept();
  ASSERT_GT(taken, 200U);
  EXPECT_GT(more.readmitted, taken / 2);
  EXPECT_EQ(more.kept(), cleaned.kept() + more.readmitted);
  EXPECT_TRUE(more.offset.isApprox(cleaned.offset)) << "limits stay";
}

TEST(Readmit, NotWhatIsWrongByChance) {
  const std::vector<State> all = states({.jumps = 0.15}, 30);
  const CleaningReport cleaned = cleanStates(all), more = readmit(all, cleaned, quick());
  const std::size_t taken = all.size() - cleaned.kept();
  ASSERT_GT(taken, 100U);
  EXPECT_LE(more.readmitted, taken / 20);
}

TEST(Readmit, NothingWhereMotionsAreTooFewOrWorkIsCancelled) {
  const std::vector<State> few = states({.stuck_beyond = 0.02}, 9);
  EXPECT_EQ(readmit(few, cleanStates(few), quick()).readmitted, 0U);
  const std::vector<State> all = states({.stuck_beyond = 0.02}, 30);
  base::Progress progress;
  progress.cancel();
  EXPECT_EQ(readmit(all, cleanStates(all), quick(), &progress).readmitted, 0U);
}

}  // namespace
}  // namespace capstan::learning
