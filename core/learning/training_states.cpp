#include "core/learning/training_states.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/learning/trial_model.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

bool mayCount(Reason reason) {
  return reason == Reason::kNone || reason == Reason::kTrajectory || misplaced(reason);
}

/// Of those that cleaning kept.
std::vector<double> ofKept(const std::vector<double>& left, const std::vector<bool>& kept) {
  std::vector<double> some;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (kept[k]) some.push_back(left[k]);
  return some;
}

/// By what is left of each; 0: it does not count. False: nothing is left of half of those kept.
bool setWeights(std::vector<State>& states, const std::vector<double>& left, const std::vector<bool>& kept) {
  const double median = stats::median(ofKept(left, kept));
  if (!(median > 0.0)) return false;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double weight = (kFreedom + 1.0) / (kFreedom + std::pow(left[k] / median, 2));
    states[k].weight = kept[k] || weight >= kAgain ? std::max(weight, kLeastWeight) : 0.0;
  }
  return true;
}

/// Leaves `after` no more than `before`, of half of the states and of the worst?
bool noWorse(const std::vector<double>& before, const std::vector<double>& after) {
  constexpr std::array kShares = {0.5, kWorst};
  const std::vector<double> was = stats::quantiles(before, kShares), is = stats::quantiles(after, kShares);
  return is[0] <= (1.0 + kByChance) * was[0] && is[1] <= (1.0 + kByChance) * was[1];
}

/// What is left of each by models of all, weighed, or, where these are worse, of what cleaning kept. Empty:
/// cancelled, or too few.
std::vector<double> leftOfEach(std::vector<State> states, const std::vector<bool>& kept,
                               const CorrectionOptions& options, base::Progress* progress,
                               const base::ProgressPart& part) {
  const std::vector<double> by_all = leftByOthers(states, options, progress, part.within(0.0, 0.33));
  if (by_all.empty()) return {};
  for (std::size_t k = 0; k < states.size(); ++k) states[k].weight = kept[k] ? 1.0 : 0.0;
  std::vector<double> by_kept = leftByOthers(states, options, progress, part.within(0.33, 0.67));
  if (by_kept.empty() || !setWeights(states, by_all, kept)) return by_kept;
  std::vector<double> by_weighed = leftByOthers(states, options, progress, part.within(0.67, 1.0));
  if (by_weighed.empty()) return {};
  return noWorse(ofKept(by_kept, kept), ofKept(by_weighed, kept)) ? by_weighed : by_kept;
}

}  // namespace

TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever) {
  TrainingStates training;
  training.states = kept(all, cleaned);
  training.offset = rigidOffset(pairsOf(training.states), lever);
  training.cleaning = std::move(cleaned);
  return training;
}

void weigh(TrainingStates& training, const std::vector<State>& all, const CleaningOptions& limits,
           const CorrectionOptions& options, base::Progress* progress, const base::ProgressPart& part) {
  CleaningReport& cleaning = training.cleaning;
  std::vector<State> some;
  std::vector<std::size_t> places;  // in `all`
  std::vector<bool> kept;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!mayCount(cleaning.reason[k]) || tooFast(all[k], limits)) continue;
    some.push_back(all[k]);
    places.push_back(k);
    kept.push_back(cleaning.reason[k] == Reason::kNone);
  }
  if (some.empty() || motionPlaces(some).back() + 1 < kFewestMotions) return;
  CorrectionOptions quicker = options;
  if (quicker.motion != Motion::kNone) quicker.motion = Motion::kVelocity;
  quicker.offset = training.offset;
  const std::vector<double> left = leftOfEach(some, kept, quicker, progress, part);
  if (left.empty() || !setWeights(some, left, kept)) return;
  training.states.clear();
  for (std::size_t k = 0; k < some.size(); ++k) {
    if (some[k].weight == 0.0) continue;
    Reason& reason = cleaning.reason[places[k]];
    if (!kept[k]) training.weighing.again.push_back(std::exchange(reason, Reason::kNone));
    training.weighing.doubted += some[k].weight < kDoubted;
    training.states.push_back(some[k]);
  }
  training.weighing.weighed = true;
}

}  // namespace capstan::learning
