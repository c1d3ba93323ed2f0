// Choice among candidate models by their posterior, with effects of the test's own. All models have the same
// residuals unless a test says otherwise: then the posterior is the prior, normalised.
#include "core/diagnosis/selection/posterior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <compare>
#include <limits>
#include <string_view>
#include <vector>

namespace capstan::diagnosis {
namespace {

struct Letter {
  std::string_view letter;
  int joint = 1;

  std::string_view name() const { return letter; }
  friend auto operator<=>(const Letter&, const Letter&) = default;
};
using Letters = SetOf<Letter>;
using Model = CandidateModel<Letter>;

const Letter kA{"a"}, kB{"b"}, kC{"c"}, kOffset{"camera_offset"}, kRotation{"camera_rotation"};

constexpr int kBlocks = 10;

BlockSquares residuals(double mean_square) {
  constexpr double kSamples = 50.0;
  return {Eigen::MatrixXd::Constant(1, kBlocks, kSamples * mean_square),
          Eigen::MatrixXd::Constant(1, kBlocks, kSamples), Eigen::VectorXd::Ones(1)};
}

struct Choice {
  BlockSquares squares = residuals(1.0);
  PredictiveScore score{
      {{0}, Eigen::VectorXd::Constant(1, 1e-3), noInputNoise(1), noInputNoise(1)}, kBlocks, kDraws, 1};
  std::vector<Model> models;

  Choice() { score.learnInflation(squares); }
  void add(const Letters& effects, double weight) { models.push_back({effects, &squares, std::log(weight)}); }
  Posterior<Letter> posterior() const { return {models, score}; }
};

TEST(Posterior, IsThePriorWhereAllModelsFitEquallyWell) {
  Choice choice;
  choice.add({}, 1.0);
  choice.add({kA}, 6.0);
  choice.add({kA, kB}, 3.0);
  const Posterior<Letter> posterior = choice.posterior();
  EXPECT_EQ(posterior.models().front().effects, Letters({kA}));
  EXPECT_NEAR(posterior.of({kA}), 0.6, 1e-12);
  EXPECT_NEAR(posterior.inclusion(kA), 0.9, 1e-12);
  EXPECT_NEAR(posterior.inclusion(kB), 0.3, 1e-12);
  EXPECT_EQ(posterior.of({kC}), 0.0);
}

TEST(Posterior, AModelWhoseSimulationDivergedIsNotInIt) {
  Choice choice;
  const BlockSquares diverged = residuals(std::numeric_limits<double>::quiet_NaN());
  choice.add({}, 1.0);
  choice.models.push_back({{kA}, &diverged, 100.0});
  EXPECT_EQ(choice.posterior().models().size(), 1U);
  choice.models.erase(choice.models.begin());
  EXPECT_TRUE(choice.posterior().models().empty());
  EXPECT_TRUE(windowOf(choice.posterior()).empty());
}

TEST(Posterior, SetsFarBelowTheBestAreNotInTheWindow) {
  Choice choice;
  choice.add({kA}, 1.0);
  choice.add({kB}, 1.1 * kOccam);
  choice.add({kC}, 0.9 * kOccam);
  const std::vector<SetProbability> sets = windowOf(choice.posterior());
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[1].effects.at(0).effect, "b");
}

TEST(Simplest, AnEffectGoesWhereTheSetWithoutItIsHalfAsProbable) {
  for (const double without : {0.4, 0.6}) {
    Choice choice;
    choice.add({kA, kB}, 1.0);
    choice.add({kA}, without);
    choice.add({kB}, 1e-3);
    const Posterior<Letter> posterior = choice.posterior();
    const Letters simple = simplest(Letters({kA, kB}), posterior);
    EXPECT_EQ(simple, without < kMinOddsWithout ? Letters({kA, kB}) : Letters({kA}));
    EXPECT_EQ(uncertainOf(Letters({kA, kB}), simple, posterior).size(), without < kMinOddsWithout ? 0U : 1U);
  }
}

TEST(Simplest, TheMostProbableOfSeveralSmallerSetsIsChosen) {
  Choice choice;
  choice.add({kA, kB}, 1.0);
  choice.add({kA}, 0.6);
  choice.add({kB}, 0.7);
  choice.add({}, 0.4);
  EXPECT_EQ(simplest(Letters({kA, kB}), choice.posterior()), Letters({kB}))
      << "and no further: the set without effects is less than half as probable as the first set";
}

TEST(Simplest, TheOffsetOfARotatedCameraGoesWithTheRotation) {
  EXPECT_TRUE(withoutEffect(Letters({kOffset, kRotation}), kRotation).empty());
  EXPECT_EQ(withoutEffect(Letters({kOffset, kRotation}), kOffset), Letters({kRotation}));
}

TEST(Selected, TheEffectWithTheLargestLossIsFirst) {
  Choice choice;
  const BlockSquares without_a = residuals(3.0), without_b = residuals(2.0), none = residuals(8.0);
  choice.models = {{{}, &none, 0.0}, {{kA}, &without_b, 0.0}, {{kB}, &without_a, 0.0}};
  choice.add({kA, kB}, 1.0);
  const auto effects =
      selectedOf(Letters({kA, kB}), choice.squares, choice.models, choice.posterior(), choice.score);
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(effects[0].effect, kA);
  EXPECT_NEAR(effects[0].loss, 250.0 * std::log(3.0), 1e-6) << "500 samples";
  EXPECT_NEAR(effects[1].loss, 250.0 * std::log(2.0), 1e-6);
  EXPECT_EQ(effects[1].without.sum, without_b.sum);
}

TEST(Competitors, AreEffectsThatReplaceASelectedOneAtComparableProbability) {
  Choice choice;
  choice.add({kA}, 1.0);
  choice.add({kB}, 0.5);
  choice.add({kC}, 0.2);      // below kTie of the two together
  choice.add({kA, kB}, 0.1);  // no exchange
  const Posterior<Letter> posterior = choice.posterior();
  const auto effects =
      selectedOf(Letters({kA}), choice.squares, {{{}, &choice.squares, 0.0}, {{kA}, &choice.squares, 0.0}},
                 posterior, choice.score);
  const auto competitors = competitorsOf(Letters({kA}), effects, posterior);
  ASSERT_EQ(competitors.size(), 1U);
  EXPECT_EQ(competitors[0].others, std::vector({kB}));
  EXPECT_NEAR(competitors[0].probabilities[0], 1.0 / 1.5, 1e-12);
  EXPECT_NEAR(competitors[0].probabilities[1], 0.5 / 1.5, 1e-12);
}

TEST(Competitors, AreFoundWhateverElseTheModelsHave) {
  Choice choice;
  choice.add({kA, kC}, 0.45);
  choice.add({kA}, 0.2);
  choice.add({kB}, 0.35);
  const Posterior<Letter> posterior = choice.posterior();
  const auto effects =
      selectedOf(Letters({kA, kC}), choice.squares,
                 {{{}, &choice.squares, 0.0}, {{kA, kC}, &choice.squares, 0.0}}, posterior, choice.score);
  const auto competitors = competitorsOf(Letters({kA, kC}), effects, posterior);
  ASSERT_EQ(competitors.size(), 1U) << "B replaces A, and not C";
  EXPECT_EQ(competitors[0].selected, kA);
  EXPECT_EQ(competitors[0].others, std::vector({kB}));
  EXPECT_NEAR(competitors[0].probabilities[1], 0.35, 1e-12);
}

TEST(Competitors, AreMoreProbableThanTheModelWithoutEither) {
  Choice choice;
  choice.add({kA}, 0.36);
  choice.add({kA, kB}, 0.24);
  choice.add({kB}, 0.16);
  choice.add({}, 0.24);
  const Posterior<Letter> posterior = choice.posterior();
  const auto effects =
      selectedOf(Letters({kA}), choice.squares, {{{}, &choice.squares, 0.0}, {{kA}, &choice.squares, 0.0}},
                 posterior, choice.score);
  EXPECT_TRUE(competitorsOf(Letters({kA}), effects, posterior).empty());
}

TEST(LogPrior, EachFurtherEffectMultipliesTheProbabilityOfTheSize) {
  EXPECT_NEAR(logPrior(0, 10), 0.0, 1e-12);
  EXPECT_NEAR(logPrior(1, 10), std::log(kEffectOdds / 10.0), 1e-12);
  EXPECT_NEAR(logPrior(2, 10), std::log(kEffectOdds * kEffectOdds / 45.0), 1e-9);
}

}  // namespace
}  // namespace capstan::diagnosis
