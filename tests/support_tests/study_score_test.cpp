// How answers are counted, on answers made by hand.
#include <cmath>

#include "tests/support_tests/study_outcomes.h"

namespace capstan::study {
namespace {

Hit hitOf(const Answer& said) { return scoreOne(backlashCase(said)).hit; }

TEST(StudyScore, EveryWayToBeRightAndWrong) {
  const NamedCause right = cause("backlash", 2), joint = cause("backlash", 3), other = cause("slack", 2);
  EXPECT_EQ(hitOf(answer("found", {right})), Hit::kRight);
  EXPECT_EQ(hitOf(answer("several", {right, other})), Hit::kRight);
  EXPECT_EQ(hitOf(answer("several", {other, right})), Hit::kLater);
  EXPECT_EQ(hitOf(answer("found", {joint})), Hit::kWrongJoint);
  EXPECT_EQ(hitOf(answer("found", {other})), Hit::kWrong);
  EXPECT_EQ(hitOf(answer("tie", {}, {{other, right}})), Hit::kTie);
  EXPECT_EQ(hitOf(answer("tie", {right}, {{right, other}})), Hit::kTie);  // it cannot tell: no strict hit
  EXPECT_EQ(hitOf(answer("tie", {}, {{other, joint}})), Hit::kWrong);
  EXPECT_EQ(hitOf(answer("nothing")), Hit::kNothing);
  EXPECT_EQ(hitOf(answer("unexplained")), Hit::kUnexplained);
  EXPECT_EQ(hitOf(answer("error")), Hit::kError);
}

TEST(StudyScore, BackgroundTextureThatIsThereMayBeNamed) {
  const NamedCause right = cause("backlash", 2), there = cause("capstan_eccentricity", 1),
                   not_there = cause("capstan_eccentricity", 3);
  CaseOutcome one = backlashCase(answer("several", {there, right}));
  test::Planted texture;
  texture.effect = test::Effect::kCapstanEccentricity;
  texture.joint = 0;
  one.truth.texture = {texture};
  EXPECT_EQ(scoreOne(one).hit, Hit::kRight);
  one.answer = answer("several", {not_there, right});
  EXPECT_EQ(scoreOne(one).hit, Hit::kLater);
  one.answer = answer("found", {there});
  EXPECT_EQ(scoreOne(one).hit, Hit::kNothing);
  EXPECT_FALSE(isAlarm(one));
  one.answer = answer("found", {not_there});
  EXPECT_TRUE(isAlarm(one));
}

TEST(StudyScore, CandidatesAreKeptByScore) {
  diagnosis::Report report;
  const auto candidate = [&](const char* effect, int round, double score) {
    diagnosis::Candidate& one = report.candidates.emplace_back();
    one.effect = effect, one.round = round, one.score = score;
  };
  for (const double score : std::vector<double>{1.0, NAN, 5.0, 3.0, -2.0, 4.0}) candidate("slack", 1, score);
  candidate("payload", 2, 9.0);
  const Answer said = answerOf(report, 1.0);
  ASSERT_EQ(said.candidates.size(), kRanked);
  EXPECT_EQ(said.candidates.front().score, 5.0);
  EXPECT_EQ(said.candidates.back().score, -2.0);
}

TEST(StudyScore, WhatIsNamedOfATie) {
  const Answer with = answer("tie", {}, {{cause("slack", 2), cause("backlash", 2)}});
  EXPECT_EQ(scoreOne(backlashCase(with)).named, "backlash");
  const Answer without = answer("tie", {}, {{cause("slack", 2), cause("backlash", 3)}});
  EXPECT_EQ(scoreOne(backlashCase(without)).named, "slack");
  EXPECT_EQ(scoreOne(backlashCase(answer("nothing"))).named, "nothing");
}

TEST(StudyScore, NumbersCountWhereTheEffectWasNamedAlone) {
  const NamedCause right = cause("backlash", 2, {{"half_width", 0.11, 0.02}});
  EXPECT_EQ(scoreOne(backlashCase(answer("found", {right}))).numbers.size(), 1U);
  EXPECT_TRUE(scoreOne(backlashCase(answer("tie", {}, {{right, cause("slack", 2)}}))).numbers.empty());
  EXPECT_TRUE(scoreOne(backlashCase(answer("several", {cause("slack", 2), right}))).numbers.empty());
}

TEST(StudyScore, TwoEffectsInAnyOrder) {
  CaseOutcome two{{Kind::kTwo, Robot::kRaven, "", 1},
                  {{item("backlash", 2, 0.5), item("payload", 0, 0.3)}, {}, 30.0, NAN},
                  answer("several", {cause("payload", 0), cause("backlash", 2)})};
  EXPECT_TRUE(scoreTwo(two).both());
  two.answer = answer("several", {cause("payload", 0)}, {{cause("slack", 2), cause("backlash", 2)}});
  EXPECT_FALSE(scoreTwo(two).both());
  EXPECT_TRUE(scoreTwo(two).bothWithTies());
  two.answer = answer("found", {cause("payload", 0)});
  EXPECT_FALSE(scoreTwo(two).bothWithTies());
  EXPECT_EQ(scoreTwo(two).right(), 1);
  two.answer = answer("nothing");
  EXPECT_EQ(scoreTwo(two).right(), 0);
  two.answer = answer("error", {cause("payload", 0), cause("backlash", 2)});
  EXPECT_EQ(scoreTwo(two).right(), 0);
}

/// Eight cases: 5 right (one number of them outside), 1 tie, 1 nothing, 1 wrong; two sound robots, one
/// accused; two uncovered.
std::vector<CaseOutcome> smallStudy() {
  std::vector<CaseOutcome> all;
  for (int k = 0; k < 5; ++k)
    all.push_back(backlashCase(answer("found", {cause("backlash", 2, {{"half_width", 0.1, k ? 0.01 : 0.0}})}),
                               0.4 + 0.1 * k, static_cast<std::uint64_t>(k)));
  all.front().answer.causes.front().numbers.front().value = 0.2;
  all.push_back(backlashCase(answer("tie", {}, {{cause("slack", 2), cause("backlash", 2)}}), 0.3, 6));
  all.push_back(backlashCase(answer("nothing"), 0.1, 7));
  all.push_back(backlashCase(answer("found", {cause("slack", 2)}), 0.15, 8));
  for (std::uint64_t seed : {1, 2})
    all.push_back({{Kind::kNone, Robot::kArm, "", seed},
                   {{}, {}, 30.0, NAN},
                   seed == 1 ? answer("found", {cause("inertia", 1)}) : answer("nothing")});
  for (const char* effect : {"external_vibration", "encoder_drift"})
    all.push_back({{Kind::kUncovered, Robot::kRaven, effect, 1},
                   {{item(effect, 1, 0.5)}, {}, 30.0, NAN},
                   effect[1] == 'x' ? answer("unexplained") : answer("found", {cause("homing_offset", 1)})});
  return all;
}

const Aim& aimOf(const Summary& summary, const std::string& what) {
  for (const Aim& aim : summary.aims)
    if (aim.what == what) return aim;
  throw std::logic_error("no aim " + what);
}

void expectAim(const Summary& summary, const std::string& what, int hits, int trials) {
  const Aim& aim = aimOf(summary, what);
  EXPECT_EQ(aim.result.hits, hits) << what;
  EXPECT_EQ(aim.result.trials, trials) << what;
}

TEST(StudySummary, CountsWhatItSays) {
  const Summary summary = summaryOf(smallStudy());
  expectAim(summary, "right name and joint first", 5, 8);
  expectAim(summary, "an honest tie that contains it", 1, 8);
  expectAim(summary, "numbers of these inside their 95 %", 4, 5);
  expectAim(summary, "false alarms", 1, 2);
  expectAim(summary, "… that name a cause", 1, 2);
  expectAim(summary, "both of two", 0, 0);
  expectAim(summary, "\"unexplained\" of vibration and spring", 1, 1);
  expectAim(summary, "… of encoder_drift", 0, 1);
  EXPECT_FALSE(aimOf(summary, "right name and joint first").met());
  EXPECT_TRUE(aimOf(summary, "\"unexplained\" of vibration and spring").met());
  EXPECT_FALSE(aimOf(summary, "both of two").met());  // nothing was asked
  // Clopper and Pearson's upper bound without a hit in n is 1 − 0.025^(1/n).
  Proportion none;
  for (int k = 0; k < 80; ++k) none.add(false);
  EXPECT_NEAR(none.interval().high, 1.0 - std::pow(0.025, 1.0 / 80.0), 1e-12);
  EXPECT_EQ(none.interval().low, 0.0);
}

TEST(StudySummary, ConfusionEffectsAndMisses) {
  const Summary summary = summaryOf(smallStudy());
  const auto count = [&](const char* planted, const char* named) {
    const auto found = summary.confusion.counts.find({planted, named});
    return found == summary.confusion.counts.end() ? 0 : found->second;
  };
  EXPECT_EQ(count("backlash", "backlash"), 6);
  EXPECT_EQ(count("backlash", "slack"), 1);
  EXPECT_EQ(count("backlash", "nothing"), 1);
  EXPECT_EQ(count("nothing", "inertia"), 1);
  EXPECT_EQ(count("nothing", "nothing"), 1);
  EXPECT_EQ(count("encoder_drift", "homing_offset"), 1);
  EXPECT_EQ(summary.confusion.planted,
            (std::vector<std::string>{"backlash", "external_vibration", "encoder_drift", "nothing"}));
  ASSERT_EQ(summary.effects.size(), 1U);
  EXPECT_EQ(summary.effects[0].count(Hit::kRight), 5);
  EXPECT_EQ(summary.effects[0].cases(), 8);
  EXPECT_NEAR(summary.effects[0].limit.size, std::sqrt(0.15 * 0.3), 1e-12);
  EXPECT_EQ(summary.outside.size(), 1U);
  EXPECT_EQ(summary.misses.size(), 4U);  // nothing, wrong, false alarm, drift
  EXPECT_EQ(summary.seconds.size(), 12U);
}

TEST(DetectionLimit, LiesBetweenWhatIsMissedAndWhatIsFound) {
  using Kind = DetectionLimit::Kind;
  const auto limit = [](std::vector<double> missed, std::vector<double> found) {
    std::vector<Trial> trials;
    for (const double size : missed) trials.push_back({size, false});
    for (const double size : found) trials.push_back({size, true});
    return detectionLimit(trials);
  };
  const DetectionLimit clean = limit({0.1, 0.15, 0.2}, {0.8, 0.5, 0.4});
  EXPECT_EQ(clean.kind, Kind::kWithin);
  EXPECT_NEAR(clean.size, std::sqrt(0.2 * 0.4), 1e-12);
  // 0.1 missed, {0.2 found, 0.3 missed} pooled to one half, the rest found.
  const DetectionLimit mixed = limit({0.1, 0.3}, {0.2, 0.5, 0.6, 0.9});
  EXPECT_NEAR(mixed.size, std::sqrt(0.2 * 0.3), 1e-12);
  EXPECT_EQ(mixed.low, 0.2);
  EXPECT_EQ(mixed.high, 0.3);
  // {0.2 found, 0.3 missed, 0.4 missed} are pooled to a third.
  EXPECT_NEAR(limit({0.1, 0.3, 0.4}, {0.2, 0.6, 0.9}).size, std::sqrt(0.4 * 0.6), 1e-12);
  EXPECT_EQ(limit({}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}).kind, Kind::kBelow);
  EXPECT_EQ(limit({}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}).size, 0.1);
  EXPECT_EQ(limit({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {}).kind, Kind::kAbove);
  EXPECT_EQ(limit({0.1}, {0.2, 0.3}).kind, Kind::kTooFew);
}

/// Seeds of a known curve: half are found at size 0.3.
TEST(DetectionLimit, FindsTheMiddleOfALogisticCurve) {
  base::Random random(3);
  std::vector<Trial> trials;
  for (int k = 0; k < 4000; ++k) {
    const double size = std::exp(random.uniform(std::log(0.1), 0.0));
    trials.push_back({size, random.uniform(0.0, 1.0) < 1.0 / (1.0 + std::pow(size / 0.3, -4.0))});
  }
  EXPECT_NEAR(detectionLimit(trials).size, 0.3, 0.02);
}

}  // namespace
}  // namespace capstan::study
