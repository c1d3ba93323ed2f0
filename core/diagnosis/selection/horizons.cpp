#include "core/diagnosis/selection/horizons.h"

#include <algorithm>
#include <string>

#include "core/diagnosis/selection/verdict.h"

namespace capstan::diagnosis {
namespace {

/// Largest number of effects in the first search, which is to bring the constants near and to find the
/// largest effects only.
constexpr int kFirstCauses = 2;

bool sameEffects(const Selection& a, const Selection& b) {
  const auto setOf = [](const Selection& s) {
    EffectSet set;
    for (const SelectedEffect& one : s.effects) set = plus(std::move(set), one.effect);
    return set;
  };
  return setOf(a) == setOf(b);
}

/// Hypotheses of the selected effects and of their competitors.
std::vector<std::string> namesOf(const Selection& selection) {
  std::vector<std::string> names;
  for (const SelectedEffect& one : selection.effects) names.emplace_back(one.effect.name());
  for (const CompetingExplanations& competing : selection.competitors)
    for (const EffectCandidate& one : competing.others) names.emplace_back(one.name());
  return names;
}

/// Candidates of a search, with the probabilities of `final`, which has searched among their hypotheses
/// again. Effects that it did not consider are in none of its models.
std::vector<Candidate> withProbabilitiesOf(const Selection& final, std::vector<Candidate> candidates) {
  for (Candidate& candidate : candidates) {
    candidate.probability = 0.0;
    const auto is_it = [&](const auto& effect, int joint) {
      return effect == candidate.effect && joint == candidate.joint;
    };
    for (const Candidate& one : final.candidates)
      if (is_it(one.effect, one.joint)) candidate.probability = one.probability;
    for (const SelectedEffect& one : final.effects)
      if (is_it(one.effect.name(), one.effect.joint)) candidate.probability = one.probability;
  }
  return candidates;
}

/// Whether the selected effects leave more than noise of the sensors and inputs.
bool leavesMoreThanNoise(const SelectionWithData& found) {
  const Selection& selection = found.selection;
  for (Eigen::Index c = 0; c < selection.best_squares.sum.rows(); ++c)
    if (selection.best_squares.meanSquare(c) > mostByChance(*found.data, selection, c)) return true;
  return false;
}

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

}  // namespace

SelectionWithData selectOverHorizons(const std::vector<Evidence>& recordings,
                                     const robot::Description& nominal, const FitModel& base,
                                     EncoderZeros zeros, int threads, const SearchOptions& options,
                                     base::Progress* progress) {
  const auto over = [&](double horizon, const Selection* start, const SearchOptions& how) {
    auto data = std::make_unique<FitData>(recordings, nominal, horizon, zeros, threads, progress);
    Selection selection = select(*data, recordings, base, start, how, progress);
    return SelectionWithData{std::move(data), std::move(selection)};
  };
  const bool encoders = std::ranges::all_of(recordings, &Evidence::hasEncoders);
  if (nominal.drive != DriveKind::kRigid || !encoders) return over(kFarHorizon, nullptr, options);

  constexpr double kShares[] = {0.3, 0.7};  // of the progress until the end of each of kHorizons
  SearchOptions how = options;
  how.progress_end = kShares[0] * options.progress_end;
  how.most_causes = std::min(options.most_causes, kFirstCauses);
  SelectionWithData first = over(kHorizons[0], nullptr, how);
  how.progress_end = kShares[1] * options.progress_end;
  how.most_causes = options.most_causes;
  SelectionWithData second = over(kHorizons[1], &first.selection, how);
  if (cancelled(progress)) return first;
  if (second.selection.effects.empty() || !leavesMoreThanNoise(second)) return second;
  how.progress_end = options.progress_end;
  how.only = namesOf(second.selection);
  SelectionWithData confirmed = over(kFarHorizon, &second.selection, how);
  if (cancelled(progress) || sameEffects(second.selection, confirmed.selection)) return second;
  confirmed.selection.candidates =
      withProbabilitiesOf(confirmed.selection, std::move(second.selection.candidates));
  return confirmed;
}

}  // namespace capstan::diagnosis
