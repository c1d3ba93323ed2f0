// A correction of an error that is known, judged on trajectories it has not seen, and the more states the
// better.
#include "core/learning/evaluation/correction_trial.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/held_out.h"
#include "core/learning/evaluation/learning_curve.h"
#include "core/learning/evaluation/learning_stages.h"
#include "core/learning/model/confidence_slice.h"
#include "core/recording/pose_table.h"
#include "tests/core/learning/quick_options.h"
#include "tests/support/sample_poses.h"

namespace capstan::learning {
namespace {

using learning::State;

const std::vector<State>& states() {
  static const std::vector<State> made =
      learningStages(recording::parsePoseTable(testing::samplePoseTable(), "poses.csv"), {}).states;
  return made;
}

constexpr double kRounding = 1e-6;  ///< a search ends elsewhere when sums are rounded elsewhere [m, rad]

CorrectionTrialOptions quickTrial() {
  CorrectionTrialOptions options;
  options.correction = learning::quickOptions();
  return options;
}

TEST(CorrectionTrial, HeldOutTrajectoriesAreBetterAtEachStep) {
  const CorrectionTrial trial = correctionTrial(states(), quickTrial());
  ASSERT_TRUE(trial.model);
  EXPECT_EQ(trial.motions, 20U);
  EXPECT_EQ(trial.motions_held, 4U);
  EXPECT_EQ(trial.corrected.size(), states().size());
  for (const State& state : trial.learned) EXPECT_FALSE(trial.held[state.motion]);
  const double none = trial.clean[0].summed().median_distance,
               offset = trial.clean[1].summed().median_distance,
               corrected = trial.clean[2].summed().median_distance;
  EXPECT_GT(none, 0.1);
  EXPECT_LT(offset, 5e-3);
  EXPECT_LT(corrected, 0.4 * offset);
  EXPECT_GE(trial.dirty[2].apart.size(), trial.clean[2].apart.size());
}

TEST(CorrectionTrial, ErrorsAreThoseOfTheStudysLastMethod) {
  CorrectionTrialOptions with_history = quickTrial();
  with_history.correction.motion = learning::Motion::kHistory;
  const CorrectionTrial trial = correctionTrial(states(), with_history);
  CorrectionStudyOptions options;
  options.splits = 1;
  options.correction = learning::quickOptions();
  const CorrectionStudyReport study = correctionStudy(states(), options);
  EXPECT_NEAR(study.clean.back().distance, trial.clean[2].summed().distance, kRounding);
  EXPECT_NEAR(study.dirty.back().angle, trial.dirty[2].summed().angle, kRounding);
}

std::vector<State> noisyStates() {
  testing::SamplePoses noisy;
  noisy.trajectories = 60;
  noisy.noise = 5e-4;
  noisy.turn_noise = 5e-3;
  return learningStages(recording::parsePoseTable(testing::samplePoseTable(noisy), "p.csv"), {}).states;
}

/// White noise, all that a correction leaves here, changes from one sight to the next.
TEST(CorrectionStudy, WhatJittersIsNoise) {
  base::Random random(4, "noise");
  std::vector<State> noisy = states();
  for (State& state : noisy) {
    const auto white = [&](double sigma) {
      return Eigen::Vector3d(random.normal(0.0, sigma), random.normal(0.0, sigma), random.normal(0.0, sigma));
    };
    state.pair.told = state.pair.seen;
    state.pair.told.translation() +=
        Eigen::Vector3d(0.01, 0.0, 0.1 * state.pair.seen.translation().x()) + white(5e-4);
    const Eigen::Vector3d turn = white(5e-3);
    state.pair.told.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  CorrectionStudyOptions options;
  options.splits = 1;
  options.correction = learning::quickOptions();
  const CorrectionStudyReport study = correctionStudy(noisy, options);
  EXPECT_NEAR(study.jitter.distance, 1.0, 0.2);
  EXPECT_NEAR(study.jitter.angle, 1.0, 0.2);
}

/// Pooled: shares of the twelve trajectories that one trial holds out differ from seed to seed.
TEST(CorrectionTrial, TellsHowOftenErrorsAreAsStated) {
  const std::vector<State> states = noisyStates();
  StatedErrors pooled;
  std::size_t held = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CorrectionTrialOptions options = quickTrial();
    options.seed = seed;
    const CorrectionTrial trial = correctionTrial(states, options);
    held += trial.clean[2].distance.size();
    for (std::size_t k = 0; k < 6; ++k)
      pooled.ratio[k].insert(pooled.ratio[k].end(), trial.stated.ratio[k].begin(),
                             trial.stated.ratio[k].end());
  }
  ASSERT_EQ(pooled.states(), held);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(pooled.within(k, 1.0), normalShare(1.0), 0.06) << k;
    EXPECT_NEAR(pooled.within(k, 2.0), normalShare(2.0), 0.03) << k;
    EXPECT_LE(pooled.within(k, 1.0), pooled.within(k, 2.0)) << k;
    EXPECT_EQ(pooled.within(k, 1e9), 1.0) << k;
  }
}

TEST(StatedErrors, SharesAreThoseOfANormalDistribution) {
  EXPECT_NEAR(normalShare(1.0), 0.682689492, 1e-9);
  EXPECT_NEAR(normalShare(2.0), 0.954499736, 1e-9);
  for (const double share : {0.0, 0.3, 0.9, 0.999})
    EXPECT_NEAR(normalShare(normalSigmas(share)), share, 1e-12);
  EXPECT_EQ(StatedErrors().within(0, 1.0), 0.0);
}

TEST(CorrectionTrial, NeedsTrajectoriesToHoldOut) {
  std::vector<State> one = states();
  std::erase_if(one, [](const State& state) { return state.motion > 0; });
  EXPECT_THROW(correctionTrial(one, quickTrial()), base::InputError);
}

TEST(CorrectionTrial, StopsWithoutAModel) {
  base::Progress progress;
  progress.cancel();
  const CorrectionTrial trial = correctionTrial(states(), quickTrial(), &progress);
  EXPECT_TRUE(trial.cancelled);
  EXPECT_FALSE(trial.model);
  CorrectionStudyOptions study;
  study.correction = learning::quickOptions();
  EXPECT_TRUE(correctionStudy(states(), study, &progress).cancelled);
}

TEST(LearningCurve, FallsWithMoreStates) {
  LearningCurveOptions options;
  options.correction = learning::quickOptions();
  options.shares = {0.025, 0.25, 1.0};
  base::Progress progress;
  const LearningCurve curve = learningCurve(states(), options, &progress);
  ASSERT_EQ(curve.points.size(), 3U);
  EXPECT_LT(curve.points[0].states, curve.points[1].states);
  EXPECT_LT(curve.points[2].errors.distance, curve.points[0].errors.distance);
  EXPECT_LT(curve.points[2].errors.distance, 0.4 * curve.offset.distance);
  EXPECT_LT(curve.offset.distance, curve.none.distance);
  EXPECT_EQ(curve.points[0].errors.states, curve.offset.states) << "all are judged on the same states";
  EXPECT_EQ(curve.motions_held, 4U);
}

TEST(LearningCurve, OfAllStatesIsTheTrial) {
  LearningCurveOptions options;
  options.correction = learning::quickOptions();
  options.shares = {1.0};
  const LearningCurve curve = learningCurve(states(), options);
  CorrectionTrialOptions plain = quickTrial();
  plain.weigh = false;
  const CorrectionTrial trial = correctionTrial(states(), plain);
  EXPECT_EQ(curve.points[0].states, trial.learned.size());
  EXPECT_NEAR(curve.points[0].errors.distance, trial.clean[2].summed().distance, kRounding);
}

TEST(LearningCurve, KeepsWhatWasDone) {
  base::Progress progress;
  progress.cancel();
  const LearningCurve curve = learningCurve(states(), {}, &progress);
  EXPECT_TRUE(curve.cancelled);
  EXPECT_TRUE(curve.points.empty());
}

TEST(HeldOut, SplitsByTrajectoryAndBySeed) {
  const std::vector<bool> held = heldOut(states(), 0.2, 1);
  EXPECT_EQ(std::count(held.begin(), held.end(), true), 4);
  EXPECT_EQ(held, heldOut(states(), 0.2, 1));
  EXPECT_NE(held, heldOut(states(), 0.2, 2));
  const SplitStates split = splitStates(states(), held);
  EXPECT_EQ(split.train.size() + split.test.size(), states().size());
  for (const State& state : split.test) EXPECT_TRUE(held[state.motion]);
}

TEST(ConfidenceSlice, IsSureWhereItWasTaughtAndNowhereFarFromIt) {
  const CorrectionTrial trial = correctionTrial(states(), quickTrial());
  learning::SliceOptions options;
  options.cells = 17;
  options.margin = 0.06;
  for (int axis = 0; axis < 3; ++axis) {
    options.axis = axis;
    const learning::ConfidenceSlice slice = confidenceSlice(*trial.model, trial.learned, options);
    ASSERT_EQ(std::max(slice.confidence.rows(), slice.confidence.cols()), 17);
    EXPECT_GT(slice.confidence.maxCoeff(), 0.6) << axis;
    EXPECT_LT(slice.confidence(0, 0), 0.05) << "a corner, six centimetres away";
    EXPECT_NE(slice.right, axis);
    EXPECT_NE(slice.up, axis);
    for (const Eigen::Vector2d& at : slice.learned)
      EXPECT_TRUE((at.array() > slice.low.array()).all() && (at.array() < slice.high.array()).all());
  }
}

TEST(ConfidenceSlice, SaysOfManyWhatCorrectSaysOfOne) {
  const CorrectionTrial trial = correctionTrial(states(), quickTrial());
  const std::vector<State> some(trial.learned.begin(), trial.learned.begin() + 5);
  const Eigen::VectorXd many = trial.model->confidence(some);
  for (std::size_t k = 0; k < some.size(); ++k)
    EXPECT_NEAR(many[static_cast<Eigen::Index>(k)], trial.model->correct(some[k]).confidence, 1e-9);
}

}  // namespace
}  // namespace capstan::learning
