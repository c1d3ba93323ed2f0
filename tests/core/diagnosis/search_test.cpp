// The search over sets of effects, on a robot with two effects that hide each other.
#include "core/diagnosis/selection/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/selection.h"
#include "core/robot/transmission.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

EffectCandidate at(std::string_view name, int joint) { return {hypothesisNamed(name), joint}; }

/// An elbow whose pulley is larger by a share m, homed where the error that this makes has no mean: of the
/// error −m (q − q_hs), which is large all over the range, only −m (q − mean q) is in the recording. Neither
/// effect alone has such an error.
struct Hidden {
  robot::Description robot = raven();
  double share = 0.0, offset = 0.0;  ///< m, and of the homing [rad]
  std::vector<Evidence> evidence;
  EffectSet planted = plus(plus(EffectSet(), at("pulley_radius", 2)), at("homing_offset", 2));

  explicit Hidden(double duration = 10.0) {
    test::DrawOptions options;
    options.robot = robot;
    options.effect = test::Effect::kPulleyRadius;
    options.joint = 2;
    options.size = 1.0;
    options.textured = false;
    options.duration = duration;
    options.sensors.cameras = false;
    auto [recording, truth] = test::recordWithTruth(test::draw(21, options));
    share = truth.items.front().planted.magnitude;
    homeElsewhere(recording.table);
    evidence.push_back(evidenceOf(recording.table, robot));
  }

  /// A stop that is off by o: s_l = r_l ∘ A (q − q_hs − o e), hence a motor counts r_l A e o / (r_mc / N)
  /// less.
  void homeElsewhere(recording::MeasuredTable& table) {
    const robot::Transmission transmission(robot);
    robot::JointVector mean(3);
    for (std::size_t j = 0; j < 3; ++j)
      mean[static_cast<Eigen::Index>(j)] =
          std::accumulate(table.q[j].begin(), table.q[j].end(), 0.0) / static_cast<double>(table.q[j].size());
    const double travel = transmission.coupling().row(1).dot(mean - transmission.homing());
    offset = share / (1.0 + share) * travel / transmission.coupling()(1, 1);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double radius = transmission.linkRadius()[i] * (i == 1 ? 1.0 + share : 1.0);
      const double less = radius * transmission.coupling()(i, 1) * offset / transmission.motorRadius()[i];
      for (double& q_m : table.q_m[static_cast<std::size_t>(i)]) q_m -= less;
    }
  }

  FitData data(int threads = 2, const base::Progress* progress = nullptr) const {
    return {evidence, robot, 2.0, EncoderZeros::kKnown, threads, progress};
  }
  FitModel nominal() const { return FitModel(robot, jointScales(evidence, robot)); }
};

SearchOptions amongSix() {
  return {.most_causes = 3,
          .refits = 4,
          .only = {"pulley_radius", "homing_offset", "cable_coupling", "capstan_eccentricity",
                   "position_stiffness", "viscous_friction"},
          .seed = 1};
}

EffectSet setOf(const SetProbability& named) {
  EffectSet set;
  for (const NamedEffect& one : named.effects) set = plus(std::move(set), at(one.effect, one.joint));
  return set;
}

double valueOf(const Fit& fit, const EffectCandidate& effect) {
  for (std::size_t k = 0; k < fit.model.effects().size(); ++k) {
    const EffectTerm& term = fit.model.effects()[k];
    if (!term.background && EffectCandidate{term.hypothesis, term.joint} == effect)
      return fit.model.effectValues(k, fit.u).front();
  }
  ADD_FAILURE() << effect.hypothesis->name() << " is not in the model";
  return 0.0;
}

TEST(LogPrior, IsThatOfAnOddsForEachEffectAndAllSetsOfASizeAlike) {
  EXPECT_EQ(logPrior(0, 10), 0.0);
  EXPECT_NEAR(logPrior(1, 10), std::log(0.25 / 10.0), 1e-12);
  EXPECT_NEAR(logPrior(2, 10), std::log(0.0625 / 45.0), 1e-12);
  EXPECT_NEAR(logPrior(3, 10), std::log(0.015625 / 120.0), 1e-12);
  EXPECT_NEAR(logPrior(4, 4), 4.0 * std::log(0.25), 1e-12) << "one set";
  EXPECT_GT(logPrior(1, 10), logPrior(1, 100)) << "among more candidates each is less probable";
}

TEST(SearchSets, FindsTwoEffectsThatHideEachOther) {
  const Hidden hidden;
  const FitData data = hidden.data();
  const Selection s = select(data, hidden.evidence, hidden.nominal(), nullptr, amongSix(), nullptr);
  EffectSet selected;
  for (const SelectedEffect& one : s.effects) selected = plus(std::move(selected), one.effect);
  EXPECT_EQ(selected, hidden.planted);
  ASSERT_GE(s.posterior.size(), 1U);
  EXPECT_EQ(setOf(s.posterior.front()), hidden.planted);
  double sum = 0.0;
  for (const SetProbability& set : s.posterior) {
    EXPECT_LE(set.probability, s.posterior.front().probability);
    sum += set.probability;
  }
  EXPECT_GT(sum, 0.9);
  EXPECT_LT(sum, 1.0 + 1e-9);
  EXPECT_TRUE(std::ranges::is_sorted(s.effects, std::greater<>(), &SelectedEffect::loss));
  for (const SelectedEffect& one : s.effects) {
    EXPECT_GT(one.loss, 6.0) << one.effect.hypothesis->name();
    EXPECT_GT(one.probability, 0.9) << one.effect.hypothesis->name();
  }
  EXPECT_NEAR(valueOf(s.best, at("pulley_radius", 2)), hidden.share, 0.1 * std::abs(hidden.share));
  EXPECT_NEAR(valueOf(s.best, at("homing_offset", 2)), hidden.offset, 0.1 * std::abs(hidden.offset));
  EXPECT_LE(s.best_squares.meanSquare(1), 2.0 * data.channels()[1].noise * data.channels()[1].noise);
}

/// From one right effect and a wrong one, and with no room for a third.
TEST(SearchSets, ExchangesAnEffectThatAnotherOneReplaces) {
  const Hidden hidden;
  const FitData data = hidden.data();
  const FitModel nominal = hidden.nominal();
  const EffectSet wrong = plus(plus(EffectSet(), at("pulley_radius", 2)), at("capstan_eccentricity", 2));
  Fit start{.model = nominal};
  for (const EffectCandidate& effect : wrong)
    start.model = start.model.with(*effect.hypothesis, effect.joint,
                                   effect.hypothesis->starts(scalesOf(nominal.scales(), 2), 2).front());
  start.u = Eigen::VectorXd::Zero(start.model.size());
  SearchOptions options = amongSix();
  options.most_causes = 2;
  const SearchResult found = searchSets(data, hidden.evidence, nominal, &start, options, nullptr);
  EXPECT_EQ(found.best, hidden.planted);
  ASSERT_TRUE(found.sets.contains(wrong)) << "where it started";
  ASSERT_TRUE(found.sets.contains(found.best));
  for (const auto& [effects, set] : found.sets) EXPECT_LE(effects.size(), 2U);
  EXPECT_GT(found.sets.at(wrong).squares.meanSquare(1), found.sets.at(found.best).squares.meanSquare(1));
  EXPECT_TRUE(found.sets.at(found.best).settled);
  EXPECT_GT(found.sets.at(found.best).fit.jacobian.size(), 0) << "not thinned";
  EXPECT_GT(found.sets.at({}).fit.jacobian.size(), 0) << "not thinned";
  EXPECT_NEAR(found.prior.costOfOneMore(0), std::log(18.0 / kEffectOdds), 1e-12)
      << "six hypotheses on three joints";
}

TEST(SearchSets, CancelledBeforeItBeginsItHasTheNominalStructureAlone) {
  const Hidden hidden(6.0);
  base::Progress progress;
  const FitData data = hidden.data(2, &progress);
  progress.cancel();
  const SearchResult found =
      searchSets(data, hidden.evidence, hidden.nominal(), nullptr, amongSix(), &progress);
  EXPECT_TRUE(found.best.empty());
  EXPECT_EQ(found.sets.size(), 1U);
  EXPECT_TRUE(found.tested.empty());
}

/// The fit that runs is cut short, and none of the eight is fitted to the end. Three leave the watch some
/// time to notice.
TEST(SearchSets, CancelledItEndsWithinTheFitsThatRun) {
  const Hidden hidden(6.0);
  const FitData data = hidden.data();
  base::Progress progress;
  std::atomic<bool> over = false, refitting = false;
  std::thread watch([&] {
    while (!over && !refitting)
      if (progress.doing().starts_with("Refitting with")) refitting = true;
    progress.cancel();
  });
  SearchOptions options = amongSix();
  options.refits = 8;
  const SearchResult found = searchSets(data, hidden.evidence, hidden.nominal(), nullptr, options, &progress);
  over = true;
  watch.join();
  EXPECT_TRUE(refitting);
  EXPECT_TRUE(found.best.empty());
  EXPECT_EQ(found.sets.size(), 1U);
  for (const Candidate& candidate : found.tested) EXPECT_EQ(candidate.round, 1);
  EXPECT_EQ(std::ranges::count(found.tested, true, &Candidate::refitted), 0);
}

TEST(SearchSets, EndsAtItsLimitAndSaysSo) {
  const Hidden hidden(6.0);
  const FitData data = hidden.data(), again = hidden.data();
  SearchOptions options = amongSix();
  const SearchResult whole = searchSets(data, hidden.evidence, hidden.nominal(), nullptr, options, nullptr);
  EXPECT_TRUE(whole.complete);
  options.effort = 0.5 * data.work() / kMostWork;
  const SearchResult half = searchSets(again, hidden.evidence, hidden.nominal(), nullptr, options, nullptr);
  EXPECT_FALSE(half.complete);
  EXPECT_LT(half.sets.size(), whole.sets.size());
  EXPECT_TRUE(half.sets.contains({}));
  EXPECT_TRUE(half.sets.at(half.best).settled);
  EXPECT_GT(again.work(), 0.5 * data.work());
  EXPECT_LT(again.work(), data.work());
}

TEST(Select, IsTheSameWhateverTheThreads) {
  const Hidden hidden(6.0);
  SearchOptions options{.most_causes = 2, .refits = 2, .only = {"pulley_radius", "homing_offset"}, .seed = 1};
  const FitData one_thread = hidden.data(1), two_threads = hidden.data(2);
  const Selection one = select(one_thread, hidden.evidence, hidden.nominal(), nullptr, options, nullptr),
                  two = select(two_threads, hidden.evidence, hidden.nominal(), nullptr, options, nullptr);
  ASSERT_FALSE(one.effects.empty());
  ASSERT_EQ(one.effects.size(), two.effects.size());
  for (std::size_t k = 0; k < one.effects.size(); ++k) {
    EXPECT_EQ(one.effects[k].effect, two.effects[k].effect);
    EXPECT_EQ(one.effects[k].loss, two.effects[k].loss);
    EXPECT_EQ(one.effects[k].probability, two.effects[k].probability);
  }
  EXPECT_EQ(one.best.u, two.best.u);
  ASSERT_EQ(one.posterior.size(), two.posterior.size());
  for (std::size_t k = 0; k < one.posterior.size(); ++k) {
    EXPECT_EQ(setOf(one.posterior[k]), setOf(two.posterior[k]));
    EXPECT_EQ(one.posterior[k].probability, two.posterior[k].probability);
  }
}

}  // namespace
}  // namespace capstan::diagnosis
