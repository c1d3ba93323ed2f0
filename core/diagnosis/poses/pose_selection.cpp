#include "core/diagnosis/poses/pose_selection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "core/diagnosis/poses/pose_channels.h"

namespace capstan::diagnosis {
namespace {

using PoseSet = SetOf<PoseEffect>;

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

struct FittedSet {
  PoseFit fit;
  BlockSquares squares;  ///< held out
};

/// Each axis of the tip is one sensor.
ScoredChannels channelsOf(const PoseData& data, const PoseFit& base) {
  return {{0, 1, 2}, noiseOf(data, base.e), noInputNoise(3), noInputNoise(3)};
}

class PoseSearch {
 public:
  PoseSearch(const PoseData& data, const std::vector<PoseHypothesis>& effects, std::uint64_t seed,
             base::Progress* progress)
      : data_(data),
        progress_(progress),
        base_(fitPoses(data, {}, {})),
        score_(channelsOf(data, base_), data.blocks(), kDraws, seed) {
    for (const PoseHypothesis& hypothesis : effects) effects_.push_back({&hypothesis});
  }

  PoseSelection run() {
    keep({}, base_);
    while (const std::optional<PoseSet> next = nextToExpand()) expand(*next);
    return selection();
  }

 private:
  double value(const PoseSet& effects) const { return score_.of(sets_.at(effects).squares) + prior(effects); }
  double prior(const PoseSet& effects) const {
    return logPrior(effects.size(), static_cast<int>(effects_.size()));
  }

  void keep(const PoseSet& effects, PoseFit fit) {
    BlockSquares squares = squaresOf(data_, heldOut(data_, fit));
    score_.learnInflation(squares);
    fit.jacobian.resize(0, 0), fit.weight.resize(0);  // of all fits they would fill the memory
    sets_.insert_or_assign(effects, FittedSet{std::move(fit), std::move(squares)});
  }

  /// Best set that is not expanded yet and is within kOccam of the best one; none: the search ends.
  std::optional<PoseSet> nextToExpand() const {
    if (cancelled(progress_)) return std::nullopt;
    double most = value(best()) + std::log(kOccam);
    std::optional<PoseSet> next;
    for (const auto& [effects, set] : sets_) {
      if (expanded_.contains(effects) || !(value(effects) > most)) continue;
      most = value(effects);
      next = effects;
    }
    return next;
  }

  /// Fits the neighbours of a set that were not fitted yet: with one effect more, with one less, and with one
  /// exchanged for another.
  void expand(const PoseSet& from) {
    expanded_.insert(from);
    report();
    for (const PoseEffect& effect : from) shrink(from, effect);
    for (const PoseEffect& effect : effects_) {
      if (contains(from, effect)) continue;
      extend(from, effect);
      for (const PoseEffect& other : from) extend(minus(from, other), effect);
    }
    if (from.empty() || from == best()) note(from);
  }

  PoseSet best() const {
    return std::ranges::max_element(sets_, {}, [&](const auto& one) { return value(one.first); })->first;
  }

  void extend(const PoseSet& from, const PoseEffect& effect) {
    const PoseSet more = plus(from, effect);
    if (sets_.contains(more) || !sets_.contains(from) || cancelled(progress_)) return;
    keep(more, with(data_, sets_.at(from).fit, *effect.hypothesis));
  }

  /// Fits the set without one effect, and without those that only make sense with it.
  void shrink(const PoseSet& from, const PoseEffect& effect) {
    for (const PoseSet& less : {minus(from, effect), withoutEffect(from, effect)}) {
      if (sets_.contains(less) || cancelled(progress_)) continue;
      PoseFit fit = sets_.at(from).fit;
      for (const PoseEffect& one : from)
        if (!contains(less, one)) fit = without(data_, fit, one.name());
      keep(less, std::move(fit));
    }
  }

  /// What each further effect gains beside the set.
  void note(const PoseSet& from) {
    ++round_;
    const BlockSquares& before = sets_.at(from).squares;
    std::vector<Candidate> tested;
    for (const PoseEffect& effect : effects_) {
      const auto more = sets_.find(plus(from, effect));
      if (contains(from, effect) || more == sets_.end()) continue;
      const double share = largestReduction(before, more->second.squares).share;
      tested.push_back({std::string(effect.name()), 0, round_, share, true, share,
                        score_.of(more->second.squares) - score_.of(before), 0.0});
    }
    std::ranges::stable_sort(tested, std::greater<>(), &Candidate::score);
    candidates_.insert(candidates_.end(), tested.begin(), tested.end());
  }

  std::vector<CandidateModel<PoseEffect>> models() const {
    std::vector<CandidateModel<PoseEffect>> models;
    for (const auto& [effects, set] : sets_) models.push_back({effects, &set.squares, prior(effects)});
    return models;
  }

  PoseSelection selection() {
    const Posterior<PoseEffect> posterior(models(), score_);
    const PoseSet most_probable = posterior.models().empty() ? PoseSet() : posterior.models().front().effects;
    const PoseSet selected = simplest(most_probable, posterior);
    for (const PoseEffect& effect : selected) shrink(selected, effect);  // what selectedOf() compares with
    const FittedSet& best = sets_.at(selected);
    PoseSelection s{.base = base_,
                    .best = fitPoses(data_, best.fit.effects, best.fit.value),
                    .most_probable = {},
                    .base_squares = sets_.at({}).squares,
                    .best_squares = best.squares,
                    .effects = selectedOf(selected, best.squares, models(), posterior, score_),
                    .uncertain = uncertainOf(most_probable, selected, posterior),
                    .competitors = {},
                    .posterior = windowOf(posterior),
                    .candidates = std::move(candidates_)};
    const PoseFit& most = sets_.at(most_probable).fit;
    s.most_probable = s.uncertain.empty() ? s.best : fitPoses(data_, most.effects, most.value);
    s.competitors = competitorsOf(selected, s.effects, posterior);
    for (const PoseEffect& effect : effects_)
      for (Candidate& candidate : s.candidates)
        if (candidate.effect == effect.name()) candidate.probability = posterior.inclusion(effect);
    return s;
  }

  void report() {
    constexpr double kSets = 8.0;  // that are expanded, about
    const auto done = static_cast<double>(expanded_.size());
    if (progress_) progress_->report(kProgressOfSearch * done / (done + kSets), "Fitting candidate models");
  }

  const PoseData& data_;
  base::Progress* progress_;
  PoseSet effects_;
  PoseFit base_;
  PredictiveScore score_;
  std::map<PoseSet, FittedSet> sets_;
  std::set<PoseSet> expanded_;
  std::vector<Candidate> candidates_;
  int round_ = 0;
};

}  // namespace

PoseSelection selectPoses(const PoseData& data, const std::vector<PoseHypothesis>& effects,
                          std::uint64_t seed, base::Progress* progress) {
  return PoseSearch(data, effects, seed, progress).run();
}

}  // namespace capstan::diagnosis
