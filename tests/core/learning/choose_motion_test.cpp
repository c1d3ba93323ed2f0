// History is chosen where errors depend on it, and only there.
#include "core/learning/poses/choose_motion.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/learning/quick_options.h"

namespace capstan::learning {
namespace {

/// Motions of 30 states each that turn round now and then; what has to be told is off by `lost` times the
/// mean velocity of the last 0.4 s, and by the velocity.
std::vector<State> states(std::size_t motions, double lost) {
  base::Random random(3, "states");
  std::vector<State> made;
  for (std::size_t m = 0; m < motions; ++m) {
    double x = random.uniform(-0.05, 0.05), before = 0.0;
    for (int k = 0; k < 30; ++k) {
      State state;
      state.motion = m;
      state.t = 0.1 * k;
      const double velocity = random.uniform(-0.05, 0.05);
      before = 0.7 * before + 0.3 * velocity;
      x += 0.1 * velocity;
      state.velocity[0] = velocity;
      state.drift[1][0] = before;
      state.drift[0][0] = velocity;
      state.pair.observed.translation() = Eigen::Vector3d(x, random.uniform(-0.02, 0.02), 0.0);
      state.pair.commanded = state.pair.observed;
      state.pair.commanded.translation()[1] += 0.02 * velocity + lost * before + random.normal(0.0, 5e-5);
      made.push_back(state);
    }
  }
  return made;
}

CorrectionOptions quick() {
  CorrectionOptions options = quickOptions();
  options.motion.reset();
  return options;
}

TEST(ChooseMotion, historyWhereItTells) {
  EXPECT_EQ(chooseMotion(states(40, 0.05), quick()), Motion::kHistory);
  EXPECT_EQ(chooseMotion(states(40, 0.0), quick()), Motion::kVelocity);
}

TEST(ChooseMotion, velocityWhereMotionsAreTooFewToTell) {
  EXPECT_EQ(chooseMotion(states(kFewestMotions - 1, 0.05), quick()), Motion::kVelocity);
}

TEST(ChooseMotion, isMadeByTrainingThatIsToldNone) {
  EXPECT_EQ(CorrectionModel::trained(states(40, 0.05), quick()).motion(), Motion::kHistory);
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(CorrectionModel::trained(states(40, 0.05), quick(), &progress).processes().empty());
}

}  // namespace
}  // namespace capstan::learning
