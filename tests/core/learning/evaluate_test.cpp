// A correction of an error that is known, judged on trajectories it has not seen, and the more states the
// better.
#include "core/learning/evaluation/evaluate.h"

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

/// The paper's share of a trajectory that is rejected whole, as the study has it.
LearningOptions quick() {
  LearningOptions options;
  options.cleaning = {};
  options.correction = learning::quickOptions();
  return options;
}

const PreparedStates& sample() {
  static const PreparedStates made =
      prepare(recording::parsePoseTable(testing::samplePoseTable(), "poses.csv"), quick());
  return made;
}
const std::vector<State>& states() { return sample().states; }

/// Of the sample with the quick options.
const HeldOutEvaluation& sampleEvaluation() {
  static const HeldOutEvaluation evaluation = evaluateHeldOut(sample(), quick(), {});
  return evaluation;
}

constexpr double kRounding = 1e-6;  ///< a search ends elsewhere when sums are rounded elsewhere [m, rad]

TEST(EvaluateHeldOut, TrajectoriesHeldOutAreBetterAtEachStep) {
  const HeldOutEvaluation& evaluation = sampleEvaluation();
  ASSERT_TRUE(evaluation.learned);
  EXPECT_EQ(evaluation.motions, 20U);
  EXPECT_EQ(evaluation.motions_held, 4U);
  EXPECT_EQ(evaluation.corrected.size(), states().size());
  for (const State& state : evaluation.learned->prepared.states) EXPECT_FALSE(evaluation.held[state.motion]);
  const StepErrors& clean = evaluation.test.clean;
  const double none = clean[0].summed().median_distance, offset = clean[1].summed().median_distance,
               corrected = clean[2].summed().median_distance;
  EXPECT_GT(none, 0.1);
  EXPECT_LT(offset, 5e-3);
  EXPECT_LT(corrected, 0.4 * offset);
  EXPECT_GE(evaluation.test.all[2].apart.size(), clean[2].apart.size());
  EXPECT_EQ(evaluation.test.clean_states, clean[2].apart.size());
}

TEST(EvaluateHeldOut, ErrorsAreThoseOfTheStudysLastMethod) {
  LearningOptions with_history = quick();
  with_history.correction.motion = learning::Motion::kHistory;
  const HeldOutEvaluation evaluation = evaluateHeldOut(sample(), with_history, {});
  CorrectionStudyOptions options;
  options.splits = 1;
  options.correction = learning::quickOptions();
  const CorrectionStudyReport study = correctionStudy(states(), options);
  EXPECT_NEAR(study.clean.back().distance, evaluation.test.clean[2].summed().distance, kRounding);
  EXPECT_NEAR(study.dirty.back().angle, evaluation.test.all[2].summed().angle, kRounding);
}

TEST(EvaluateHeldOut, TrainsAsLearnDoes) {
  const HeldOutEvaluation& evaluation = sampleEvaluation();
  PreparedStates others = sample();
  std::erase_if(others.states, [&](const State& state) { return evaluation.held[state.motion]; });
  const LearningReport learned = learnPrepared(others, quick());
  const std::vector<Eigen::Isometry3d> corrected = learned.model.correct(states());
  for (std::size_t k = 0; k < corrected.size(); ++k)
    EXPECT_TRUE(corrected[k].isApprox(evaluation.corrected[k], 1e-12)) << k;
}

TEST(EvaluateHeldOut, IsTheEvaluationOfTheStatesHeldOut) {
  const HeldOutEvaluation& evaluation = sampleEvaluation();
  const std::vector<State> test = splitStates(states(), evaluation.held).test;
  const Evaluation again = evaluate(*evaluation.learned, test, quick());
  EXPECT_EQ(again.states, evaluation.test.states);
  EXPECT_EQ(again.clean_states, evaluation.test.clean_states);
  EXPECT_EQ(again.clean[2].summed().distance, evaluation.test.clean[2].summed().distance);
  EXPECT_EQ(again.all[1].summed().angle, evaluation.test.all[1].summed().angle);
}

PreparedStates noisySample() {
  testing::SamplePoses noisy;
  noisy.trajectories = 60;
  noisy.noise = 5e-4;
  noisy.turn_noise = 5e-3;
  return prepare(recording::parsePoseTable(testing::samplePoseTable(noisy), "p.csv"), quick());
}

/// White noise, all that a correction leaves here, changes from one observation to the next.
TEST(CorrectionStudy, WhatJittersIsNoise) {
  base::Random random(4, "noise");
  std::vector<State> noisy = states();
  for (State& state : noisy) {
    const auto white = [&](double sigma) {
      return Eigen::Vector3d(random.normal(0.0, sigma), random.normal(0.0, sigma), random.normal(0.0, sigma));
    };
    state.pair.commanded = state.pair.observed;
    state.pair.commanded.translation() +=
        Eigen::Vector3d(0.01, 0.0, 0.1 * state.pair.observed.translation().x()) + white(5e-4);
    const Eigen::Vector3d rotation = white(5e-3);
    state.pair.commanded.rotate(Eigen::AngleAxisd(rotation.norm(), rotation.normalized()));
  }
  CorrectionStudyOptions options;
  options.splits = 1;
  options.correction = learning::quickOptions();
  const CorrectionStudyReport study = correctionStudy(noisy, options);
  EXPECT_NEAR(study.jitter.distance, 1.0, 0.2);
  EXPECT_NEAR(study.jitter.angle, 1.0, 0.2);
}

/// Pooled: shares of the twelve trajectories that one trial holds out differ from seed to seed.
TEST(StatedErrors, AreAsFrequentAsStated) {
  const PreparedStates noisy = noisySample();
  StatedErrors pooled;
  std::size_t held = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Evaluation test = evaluateHeldOut(noisy, quick(), {.seed = seed}).test;
    held += test.clean[2].distance.size();
    for (std::size_t k = 0; k < 6; ++k)
      pooled.ratio[k].insert(pooled.ratio[k].end(), test.stated.ratio[k].begin(), test.stated.ratio[k].end());
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

TEST(EvaluateHeldOut, NeedsTrajectoriesToHoldOut) {
  PreparedStates one = sample();
  std::erase_if(one.states, [](const State& state) { return state.motion > 0; });
  EXPECT_THROW(evaluateHeldOut(one, quick(), {}), base::InputError);
}

TEST(EvaluateHeldOut, StopsWithoutAModel) {
  base::Progress progress;
  progress.cancel();
  const HeldOutEvaluation evaluation = evaluateHeldOut(sample(), quick(), {}, &progress);
  EXPECT_TRUE(evaluation.cancelled);
  EXPECT_FALSE(evaluation.learned);
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

TEST(LearningCurve, OfAllStatesIsTheEvaluation) {
  LearningCurveOptions options;
  options.correction = learning::quickOptions();
  options.shares = {1.0};
  const LearningCurve curve = learningCurve(states(), options);
  LearningOptions plain = quick();
  plain.weigh = false;
  plain.correction.motion = options.correction.motion;
  const HeldOutEvaluation evaluation = evaluateHeldOut(sample(), plain, {});
  EXPECT_EQ(curve.points[0].states, evaluation.learned->cleaning.kept());
  EXPECT_NEAR(curve.points[0].errors.distance, evaluation.test.clean[2].summed().distance, kRounding);
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
  const LearningReport learned = learnPrepared(sample(), quick());
  const std::vector<State> inliers = kept(learned.prepared.states, learned.cleaning);
  learning::SliceOptions options;
  options.cells = 17;
  options.margin = 0.06;
  for (int axis = 0; axis < 3; ++axis) {
    options.axis = axis;
    const learning::ConfidenceSlice slice = confidenceSlice(learned.model, inliers, options);
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
  const LearningReport learned = learnPrepared(sample(), quick());
  const std::vector<State> some(states().begin(), states().begin() + 5);
  const Eigen::VectorXd many = learned.model.confidence(some);
  for (std::size_t k = 0; k < some.size(); ++k)
    EXPECT_NEAR(many[static_cast<Eigen::Index>(k)], learned.model.correct(some[k]).confidence, 1e-9);
}

}  // namespace
}  // namespace capstan::learning
