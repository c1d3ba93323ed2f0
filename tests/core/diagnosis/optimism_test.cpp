// Held-out scores of sets of effects: numbers by hand, on one channel with two blocks.
#include "core/diagnosis/selection/optimism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capstan::diagnosis {
namespace {

constexpr double kSamples = 100.0;  // of a block

BlockSquares squares(double variance) {
  return {Eigen::MatrixXd::Constant(1, 2, kSamples * variance), Eigen::MatrixXd::Constant(1, 2, kSamples),
          Eigen::VectorXd::Ones(1)};
}

/// Sets without an effect, with one of two and with both; variances on fitted and on held-out blocks.
struct Sets {
  EffectCandidate backlash{hypothesisNamed("backlash"), 1}, slack{hypothesisNamed("slack"), 1};
  EffectSet none, one{backlash}, both = plus(EffectSet{backlash}, slack), other{slack};
  std::map<EffectSet, SetFit> sets;
  PredictiveScore score{
      {{0}, Eigen::VectorXd::Constant(1, 1e-6), noInputNoise(1), noInputNoise(1)}, 2, 10, 1};

  void add(const EffectSet& effects, double fitted, double held_out, bool settled = true) {
    SetFit set{effects, {.model = FitModel(robot::Description(), {})}, {}};
    set.fitted = squares(fitted);
    set.squares = squares(held_out);
    set.settled = settled;
    if (settled) score.learnInflation(set.squares);
    sets.insert_or_assign(effects, std::move(set));
  }
  double at(const EffectSet& effects) const { return heldOutScores(sets, score).at(effects); }
  static double of(double variance) { return -0.5 * 2.0 * kSamples * std::log(variance); }
};

TEST(HeldOutScores, areThoseOfTheResidualsWhereLargerModelsLoseMore) {
  Sets s;
  s.add(s.none, 4.0, 4.4);
  s.add(s.one, 1.0, 1.2);
  EXPECT_NEAR(s.at(s.none), Sets::of(4.4), 1e-9);
  EXPECT_NEAR(s.at(s.one), Sets::of(1.2), 1e-9);
}

TEST(HeldOutScores, aModelLosesNoMoreThanOneThatContainsIt) {
  Sets s;
  s.add(s.none, 1.0, 2.0);  // its folds went astray: the effect looks as if it halved the error
  s.add(s.one, 1.0, 1.1);
  s.add(s.both, 0.9, 1.3);
  EXPECT_NEAR(s.at(s.none), Sets::of(1.1), 1e-9);
  EXPECT_NEAR(s.at(s.one), Sets::of(1.1), 1e-9);
  EXPECT_NEAR(s.at(s.both), Sets::of(1.3), 1e-9);
}

TEST(HeldOutScores, modelsThatDoNotContainEachOtherStandAlone) {
  Sets s;
  s.add(s.one, 1.0, 1.1);
  s.add(s.other, 1.0, 2.0);
  EXPECT_NEAR(s.at(s.other), Sets::of(2.0), 1e-9);
}

TEST(HeldOutScores, shortFitsHaveNone) {
  Sets s;
  s.add(s.none, 1.0, 2.0);
  s.add(s.one, 1.0, 1.0, false);
  EXPECT_EQ(heldOutScores(s.sets, s.score).size(), 1u);
  EXPECT_NEAR(s.at(s.none), Sets::of(2.0), 1e-9);
}

TEST(HeldOutScores, foldsThatDivergeAreCorrectedOnlyByALargerModel) {
  Sets s;
  s.add(s.none, 1.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.at(s.none), -std::numeric_limits<double>::infinity());
  s.add(s.one, 0.5, 0.6);
  EXPECT_NEAR(s.at(s.none), Sets::of(1.0) - (Sets::of(0.5) - Sets::of(0.6)), 1e-9);
}

}  // namespace
}  // namespace capstan::diagnosis
