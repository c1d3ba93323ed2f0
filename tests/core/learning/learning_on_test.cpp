// What a model does while it is in use: says when it has drifted, and where to look next.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/random.h"
#include "core/learning/model/drift_monitor.h"
#include "core/learning/model/next_poses.h"

namespace capstan::learning {
namespace {

/// States along x in [low, high], a bias that waves, stamps 0.5 s apart.
std::vector<State> along(double low, double high, std::size_t n, std::uint64_t seed, double drifted = 0.0) {
  base::Random random(seed, "states");
  std::vector<State> states(n);
  for (std::size_t k = 0; k < n; ++k) {
    State& state = states[k];
    state.t = 0.5 * static_cast<double>(k);
    const Eigen::Vector3d p(random.uniform(low, high), random.uniform(-0.02, 0.02),
                            random.uniform(-0.02, 0.02));
    state.pair.observed.translation() = p;
    state.pair.commanded.translation() =
        p + Eigen::Vector3d(2e-3 * std::sin(50.0 * p.x()) + drifted, 0.0, 0.0);
    for (int i = 0; i < 3; ++i) state.pair.commanded.translation()[i] += random.normal(0.0, 2e-4);
    state.pair.commanded.linear() =
        Eigen::AngleAxisd(random.normal(0.0, 0.01), Eigen::Vector3d::UnitX()).toRotationMatrix() *
        Eigen::AngleAxisd(random.normal(0.0, 0.01), Eigen::Vector3d::UnitY()).toRotationMatrix() *
        Eigen::AngleAxisd(random.normal(0.0, 0.01), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  return states;
}

CorrectionModel learnedFrom(const std::vector<State>& states) {
  CorrectionOptions options;
  options.motion = Motion::kNone;
  options.likelihood_points = 200;
  options.inducing_points = 150;
  return CorrectionModel::trained(states, options);
}

TEST(DriftMonitor, isSilentWhileTheModelHolds) {
  const CorrectionModel model = learnedFrom(along(-0.05, 0.05, 500, 1));
  DriftMonitor monitor(model);
  int alarms = 0;
  for (const State& state : along(-0.05, 0.05, 600, 2)) alarms += monitor.add(state).drifted;
  EXPECT_LE(alarms, 6);
}

TEST(DriftMonitor, saysWhenTheModelHasAged) {
  const CorrectionModel model = learnedFrom(along(-0.05, 0.05, 500, 1));
  DriftMonitor monitor(model);
  for (const State& state : along(-0.05, 0.05, 200, 2)) monitor.add(state);
  std::size_t until = 0;
  for (State state : along(-0.05, 0.05, 200, 3, 1e-3)) {
    state.t += 100.0;
    if (monitor.add(state).drifted) break;
    ++until;
  }
  EXPECT_LT(until, 60U) << "a millimetre is five σ of a reading: half a minute should tell";
  monitor.reset();
  EXPECT_FALSE(monitor.add(along(-0.05, 0.05, 1, 4).front()).drifted);
}

/// Two motions of 100 s, each with a clock that begins at 0; the second `drifted` off.
std::vector<State> twoMotions(double drifted) {
  std::vector<State> states = along(-0.05, 0.05, 200, 2), later = along(-0.05, 0.05, 200, 3, drifted);
  for (State& state : later) state.motion = 1;
  states.insert(states.end(), later.begin(), later.end());
  return states;
}

TEST(DriftHistory, goesOnFromMotionToMotion) {
  const CorrectionModel model = learnedFrom(along(-0.05, 0.05, 500, 1));
  const DriftHistory sound = driftAlong(model, twoMotions(0.0));
  EXPECT_GT(sound.t.size(), 390U);
  EXPECT_EQ(sound.t.size() + sound.low_confidence, 400U);
  for (std::size_t k = 1; k < sound.t.size(); ++k) EXPECT_GT(sound.t[k], sound.t[k - 1]);
  EXPECT_TRUE(sound.known());
  EXPECT_FALSE(sound.driftedNow());
  EXPECT_LT(sound.factor.maxCoeff(), 1.3);
  const DriftHistory drifted = driftAlong(model, twoMotions(1e-3));
  ASSERT_EQ(drifted.drifted.size(), 1U);
  EXPECT_TRUE(drifted.driftedNow());
  EXPECT_GT(drifted.state[drifted.drifted[0].first], 200U) << "the first motion is as learned";
  EXPECT_LT(drifted.state[drifted.drifted[0].first], 280U);
  EXPECT_GT(drifted.factor[0], 1.5);
}

TEST(DriftHistory, ofAShortMotionTellsNothing) {
  const CorrectionModel model = learnedFrom(along(-0.05, 0.05, 500, 1));
  const std::vector<State> few = along(-0.05, 0.05, 20, 3, 5e-3);  // 10 s, far off
  EXPECT_FALSE(driftAlong(model, few).known());
  EXPECT_FALSE(driftAlong(model, few).driftedNow());
  DriftOptions short_span;
  short_span.span = 1e-3;
  EXPECT_FALSE(driftAlong(model, few, short_span).known());
  EXPECT_FALSE(driftAlong(model, {}).known());
}

TEST(DriftHistory, doesNotJudgeWhereNothingWasLearned) {
  const CorrectionModel model = learnedFrom(along(-0.05, 0.0, 500, 1));
  const DriftHistory beyond = driftAlong(model, along(0.06, 0.1, 200, 3));
  EXPECT_EQ(beyond.low_confidence, 200U);
  EXPECT_FALSE(beyond.known());
}

TEST(NextPoses, canBeChosenFromAllThatWasLearned) {
  const CorrectionModel model = learnedFrom(along(-0.06, 0.06, 300, 1));
  const std::vector<State> within = posesWithin(model, 3);
  EXPECT_GE(within.size(), 27U);
  EXPECT_LE(within.size(), 27U * 7U);
  const Eigen::AlignedBox3d box = model.workspace();
  for (const State& state : within) {
    const Eigen::Vector3d at = model.offset() * state.pair.observed.translation();
    EXPECT_LT(box.exteriorDistance(at), 1e-9);
    EXPECT_TRUE(state.velocity.isZero());
  }
}

TEST(NextPoses, areEachVisitedOnceAndGainWhatTheySay) {
  const CorrectionModel model = learnedFrom(along(-0.06, 0.0, 150, 1));
  const std::vector<State> candidates = along(-0.06, 0.06, 60, 6);
  const std::vector<NextPose> next = nextPoses(model, candidates, 10);
  ASSERT_GT(next.size(), 3U);
  std::set<std::size_t> places;
  for (const NextPose& pose : next) {
    places.insert(pose.candidate);
    EXPECT_LT(pose.after, (1.0 - kLeastGain) * pose.before);
  }
  EXPECT_EQ(places.size(), next.size());
  double variance = 0.0, whole = 0.0;
  for (std::size_t g = 0; g < model.processes().size(); ++g) {
    const Committee& process = model.processes()[g];
    variance += model.weightOf(g) * process.predict(model.featuresOf(candidates)).variance.sum();
    whole += model.weightOf(g) * process.signalVariance() * 60.0;
  }
  EXPECT_NEAR(next.front().before, variance / whole, 1e-9);
}

TEST(NextPoses, lieWhereNobodyHasBeen) {
  std::vector<State> learned = along(-0.06, 0.0, 300, 1), some = along(0.05, 0.06, 4, 5);
  learned.insert(learned.end(), some.begin(), some.end());
  const CorrectionModel model = learnedFrom(learned);
  const std::vector<State> candidates = along(-0.06, 0.06, 60, 6);
  const std::vector<NextPose> next = nextPoses(model, candidates, 3);
  ASSERT_FALSE(next.empty());
  double before = next.front().before;
  for (const NextPose& pose : next) {
    EXPECT_GT(candidates[pose.candidate].pair.observed.translation().x(), 0.0);
    EXPECT_DOUBLE_EQ(pose.before, before);
    EXPECT_LT(pose.after, pose.before);
    before = pose.after;
  }
}

TEST(NextPoses, stopWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(
      nextPoses(learnedFrom(along(-0.05, 0.05, 100, 1)), along(-0.05, 0.05, 10, 2), 3, &progress).empty());
}

}  // namespace
}  // namespace capstan::learning
