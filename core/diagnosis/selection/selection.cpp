#include "core/diagnosis/selection/selection.h"

#include <algorithm>

#include "core/diagnosis/fit/input_noise.h"
#include "core/diagnosis/selection/optimism.h"
#include "core/diagnosis/selection/search_progress.h"

namespace capstan::diagnosis {
namespace {

using Model = CandidateModel<EffectCandidate>;

constexpr double kProgressOfSearch =
    0.85;  // the rest is for the fits of the selected set without its effects

PredictiveScore scoreOf(const FitData& data, const SearchResult& found, std::uint64_t seed) {
  PredictiveScore score(found.channels, data.blocks(), kDraws, seed);
  for (const auto& [effects, set] : found.sets)
    if (set.settled) score.learnInflation(set.squares);
  return score;
}

/// Sets that were fitted until convergence.
std::vector<Model> modelsOf(const SearchResult& found, const PredictiveScore& score) {
  std::vector<Model> models;
  for (const auto& [effects, held_out] : heldOutScores(found.sets, score)) {
    const SetFit& set = found.sets.at(effects);
    models.push_back({effects, &set.squares, found.prior.of(set), held_out - score.of(set.squares)});
  }
  return models;
}

/// The sets with the highest probabilities, without what can be computed again.
std::vector<ProbableSet> probableOf(const Posterior<EffectCandidate>& posterior, const SearchResult& found) {
  std::vector<ProbableSet> sets;
  for (std::size_t k = 0; k < std::min(kProbableSets, posterior.models().size()); ++k) {
    sets.push_back({found.sets.at(posterior.models()[k].effects), posterior.probability(k)});
    SetFitter::thin(sets.back().set);
  }
  return sets;
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

}  // namespace

Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                 const Selection* start, const SearchOptions& options, base::Progress* progress) {
  SearchOptions until_found = options;
  const double begin = progress ? progress->fraction() : 0.0;
  until_found.progress_end = begin + kProgressOfSearch * (options.progress_end - begin);
  SearchResult found =
      searchSets(data, recordings, nominal, start ? &start->best : nullptr, until_found, progress);
  const PredictiveScore score = scoreOf(data, found, options.seed);
  const Posterior<EffectCandidate> posterior(modelsOf(found, score), score);
  const EffectSet most_probable =
      posterior.models().empty() ? found.best : posterior.models().front().effects;
  const SetFitter fitter(data);
  const SetFit& base = found.sets.at({});
  SetFit best = found.sets.at(simplest(most_probable, posterior));
  fitter.relinearise(best);
  Selection s{.base = base.fit,
              .base_squares = base.squares,
              .input_noise = found.channels.input,
              .torque_noise = torqueNoise(data, best.fit, best.weighting),
              .best = best.fit,
              .best_squares = best.squares,
              .weighting = best.weighting,
              .effects = {},
              .uncertain = uncertainOf(most_probable, best.effects, posterior),
              .competitors = {},
              .posterior = windowOf(posterior),
              .probable = probableOf(posterior, found),
              .candidates = std::move(found.tested),
              .complete = found.complete};
  {
    SearchProgress shown(data, recordings, progress, options.progress_end);
    shown.report("Comparing with smaller models");
    settleWithouts(fitter, best, found);
  }
  s.effects = selectedOf(best.effects, best.squares, modelsOf(found, score), posterior, score);
  s.competitors = competitorsOf(best.effects, s.effects, posterior);
  for (Candidate& candidate : s.candidates)
    candidate.probability = posterior.inclusion({hypothesisNamed(candidate.effect), candidate.joint});
  return s;
}

}  // namespace capstan::diagnosis
