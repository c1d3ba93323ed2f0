#include "core/diagnosis/selection/selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Sets that were fitted to the end, with their probabilities, the most probable first.
struct Posterior {
  std::vector<const SetFit*> sets;
  VectorXd probability;

  double of(const EffectSet& effects) const {
    for (std::size_t k = 0; k < sets.size(); ++k)
      if (sets[k]->effects == effects) return probability[static_cast<Index>(k)];
    return 0.0;
  }
  /// That the model has the effect.
  double inclusion(const EffectCandidate& effect) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < sets.size(); ++k)
      if (contains(sets[k]->effects, effect)) sum += probability[static_cast<Index>(k)];
    return sum;
  }
};

PredictiveScore scoreOf(const FitData& data, const SearchResult& found, std::uint64_t seed) {
  PredictiveScore score(data, found.input_noise, kDraws, seed);
  for (const auto& [effects, set] : found.sets)
    if (set.settled) score.learnInflation(set.squares);
  return score;
}

void sortByProbability(Posterior& posterior) {
  std::vector<Index> order(posterior.sets.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](Index k) { return posterior.probability[k]; });
  const Posterior unsorted = posterior;
  for (std::size_t k = 0; k < order.size(); ++k) {
    posterior.sets[k] = unsorted.sets[static_cast<std::size_t>(order[k])];
    posterior.probability[static_cast<Index>(k)] = unsorted.probability[order[k]];
  }
}

Posterior posteriorOf(const SearchResult& found, const PredictiveScore& score) {
  Posterior posterior;
  for (const auto& [effects, set] : found.sets)
    if (set.settled && std::isfinite(score.of(set.squares))) posterior.sets.push_back(&set);
  const auto count = static_cast<Index>(posterior.sets.size());
  posterior.probability = VectorXd::Zero(count);
  if (count == 0) return posterior;
  MatrixXd log(count, kDraws);
  for (Index k = 0; k < count; ++k) {
    const SetFit& set = *posterior.sets[static_cast<std::size_t>(k)];
    log.row(k) = score.ofDraws(set.squares).transpose();
    log.row(k).array() += logPrior(set.effects, found.candidates, found.instants);
  }
  for (Index d = 0; d < log.cols(); ++d) {
    const VectorXd odds = (log.col(d).array() - log.col(d).maxCoeff()).exp();
    posterior.probability += odds / odds.sum() / static_cast<double>(kDraws);
  }
  sortByProbability(posterior);
  return posterior;
}

std::vector<SetProbability> windowOf(const Posterior& posterior) {
  std::vector<SetProbability> sets;
  const double least = posterior.sets.empty() ? 0.0 : kOccam * posterior.probability[0];
  for (std::size_t k = 0; k < posterior.sets.size(); ++k) {
    const double p = posterior.probability[static_cast<Index>(k)];
    if (p < least) continue;
    SetProbability set{{}, p};
    for (const EffectCandidate& effect : posterior.sets[k]->effects)
      set.effects.push_back({std::string(effect.hypothesis->name()), effect.joint});
    sets.push_back(std::move(set));
  }
  return sets;
}

/// The sets with the highest probabilities, without what can be computed again.
std::vector<ProbableSet> probableOf(const Posterior& posterior) {
  std::vector<ProbableSet> sets;
  for (std::size_t k = 0; k < std::min(kProbableSets, posterior.sets.size()); ++k) {
    sets.push_back({*posterior.sets[k], posterior.probability[static_cast<Index>(k)]});
    SetFitter::thin(sets.back().set);
  }
  return sets;
}

/// Most probable set of those that were fitted; the search's best where there is none.
const SetFit& mostProbable(const Posterior& posterior, const SearchResult& found) {
  return posterior.sets.empty() ? found.sets.at(found.best) : *posterior.sets.front();
}

/// Sets without one effect. A camera that rotates about its own position is a rotation about frame 0 and an
/// offset: without the rotation there is no offset either.
EffectSet withoutEffect(const EffectSet& effects, const EffectCandidate& effect) {
  EffectSet less = minus(effects, effect);
  if (effect.hypothesis->name() == "camera_rotation")
    less = minus(std::move(less), {hypothesisNamed("camera_offset"), 0});
  return less;
}

/// The simplest of the sets between which the recordings do not decide: `from` without its uncertain effects
/// (kMinOddsWithout).
const SetFit& simplest(const SetFit& from, const Posterior& posterior, const SearchResult& found) {
  const double least = kMinOddsWithout * posterior.of(from.effects);
  const SetFit* best = &from;
  for (bool simpler = true; simpler;) {
    simpler = false;
    const EffectSet effects = best->effects;
    double most = least;
    for (const EffectCandidate& effect : effects) {
      const EffectSet less = withoutEffect(effects, effect);
      const double p = posterior.of(less);
      if (!(p > most)) continue;
      most = p;
      best = &found.sets.at(less);
      simpler = true;
    }
  }
  return *best;
}

/// Best of the subsets of `effects` that were fitted to the end: a refit with one effect less may end in a
/// worse minimum than one with two less.
const SetFit& bestWithin(const EffectSet& effects, const SearchResult& found, const PredictiveScore& score) {
  const SetFit* best = &found.sets.at({});
  for (const auto& [others, set] : found.sets) {
    const bool within =
        std::ranges::all_of(others, [&](const EffectCandidate& one) { return contains(effects, one); });
    if (within && set.settled && score.of(set.squares) > score.of(best->squares)) best = &set;
  }
  return *best;
}

std::vector<SelectedEffect> effectsOf(const SetFit& best, const SearchResult& found,
                                      const Posterior& posterior, const PredictiveScore& score) {
  std::vector<SelectedEffect> effects;
  for (const EffectCandidate& effect : best.effects) {
    const BlockSquares& without = bestWithin(withoutEffect(best.effects, effect), found, score).squares;
    SelectedEffect one{effect, posterior.inclusion(effect), 0.0, without};
    one.loss = score.of(best.squares) - score.of(one.without);
    effects.push_back(std::move(one));
  }
  std::ranges::stable_sort(effects, std::greater<>(), &SelectedEffect::loss);
  return effects;
}

std::vector<CompetingExplanations> competitorsOf(const SetFit& best,
                                                 const std::vector<SelectedEffect>& effects,
                                                 const Posterior& posterior) {
  std::vector<CompetingExplanations> all;
  const double own = posterior.of(best.effects);
  for (const SelectedEffect& one : effects) {
    CompetingExplanations competing{one.effect, {}, {own}};
    const EffectSet rest = minus(best.effects, one.effect);
    for (std::size_t k = 0; k < posterior.sets.size(); ++k) {
      const EffectSet& other = posterior.sets[k]->effects;
      const double p = posterior.probability[static_cast<Index>(k)];
      if (!differByExchange(best.effects, other) || contains(other, one.effect) || p < kTie * (p + own))
        continue;
      for (const EffectCandidate& effect : other)
        if (!contains(rest, effect)) competing.others.push_back(effect);
      competing.probabilities.push_back(p);
    }
    double sum = 0.0;
    for (const double p : competing.probabilities) sum += p;
    for (double& p : competing.probabilities) p /= sum;
    if (!competing.others.empty()) all.push_back(std::move(competing));
  }
  return all;
}

/// Fits the selected set without each of its effects to the end: a short fit would overstate what the effect
/// is worth.
void settleWithouts(const SetFitter& fitter, const SetFit& best, SearchResult& found) {
  std::vector<SetFit> open;
  for (const EffectCandidate& effect : best.effects) {
    const EffectSet less = withoutEffect(best.effects, effect);
    const auto known = found.sets.find(less);
    if (known != found.sets.end() && known->second.settled) continue;
    SetFit fitted = known != found.sets.end() ? known->second : best;
    fitter.relinearise(fitted);
    for (const EffectCandidate& one : EffectSet(fitted.effects))
      if (!contains(less, one)) fitted = std::move(fitter.reduced({{&fitted, one}}).front());
    open.push_back(std::move(fitted));
  }
  for (SetFit& set : fitter.settled(std::move(open)))
    found.sets.insert_or_assign(EffectSet(set.effects), std::move(set));
}

/// Posterior inclusion of each candidate that was tested.
void addProbabilities(const Posterior& posterior, std::vector<Candidate>& candidates) {
  for (Candidate& candidate : candidates)
    candidate.probability = posterior.inclusion({hypothesisNamed(candidate.effect), candidate.joint});
}

}  // namespace

Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                 const Selection* start, const SearchOptions& options, base::Progress* progress) {
  SearchResult found =
      searchSets(data, recordings, nominal, start ? &start->best : nullptr, options, progress);
  const PredictiveScore score = scoreOf(data, found, options.seed);
  const Posterior posterior = posteriorOf(found, score);
  const SetFitter fitter(data);
  const SetFit& base = found.sets.at({});
  const SetFit& most_probable = mostProbable(posterior, found);
  SetFit best = simplest(most_probable, posterior, found);
  fitter.relinearise(best);
  settleWithouts(fitter, best, found);
  Selection s{.base = base.fit,
              .base_squares = base.squares,
              .input_noise = found.input_noise,
              .best = best.fit,
              .best_squares = best.squares,
              .weighting = best.weighting,
              .effects = effectsOf(best, found, posterior, score),
              .uncertain = {},
              .competitors = {},
              .posterior = windowOf(posterior),
              .probable = probableOf(posterior),
              .candidates = std::move(found.tested)};
  for (const EffectCandidate& effect : most_probable.effects)
    if (!contains(best.effects, effect)) s.uncertain.push_back({effect, posterior.inclusion(effect)});
  s.competitors = competitorsOf(best, s.effects, posterior);
  addProbabilities(posterior, s.candidates);
  return s;
}

}  // namespace capstan::diagnosis
