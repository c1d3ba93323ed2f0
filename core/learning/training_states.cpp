#include "core/learning/training_states.h"

#include <array>

#include "core/learning/trial_model.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

/// Motions in folds, and what models learned from the other folds leave of each state.
class Folds {
 public:
  Folds(const std::vector<State>& states, CorrectionOptions options, base::Progress* progress)
      : states_(states), options_(std::move(options)), progress_(progress) {
    if (options_.motion != Motion::kNone) options_.motion = Motion::kVelocity;  // quicker
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (k == 0 || states[k].motion != states[k - 1].motion) ++motions_;
      fold_.push_back(motions_ % kReadmissionFolds);
    }
  }

  std::size_t motions() const { return motions_; }

  /// By state [m], learned from those of other folds that `may` be; empty: cancelled, or too few to learn
  /// from.
  std::vector<double> left(const std::vector<bool>& may, const base::ProgressPart& part) const {
    std::vector<double> found(states_.size());
    for (std::size_t fold = 0; fold < kReadmissionFolds; ++fold) {
      std::vector<State> learned, held;
      for (std::size_t k = 0; k < states_.size(); ++k) {
        if (fold_[k] == fold) held.push_back(states_[k]);
        if (fold_[k] != fold && may[k]) learned.push_back(states_[k]);
      }
      if (learned.size() < kFewestStates) return {};
      const double begin = static_cast<double>(fold) / kReadmissionFolds;
      const CorrectionModel model =
          trialModel(learned, options_, progress_, part.within(begin, begin + 1.0 / kReadmissionFolds));
      if (progress_ && progress_->cancelled()) return {};
      const std::vector<double> of_held = leftOf(model, held, options_.lever);
      for (std::size_t k = 0, h = 0; k < states_.size(); ++k)
        if (fold_[k] == fold) found[k] = of_held[h++];
    }
    return found;
  }

 private:
  const std::vector<State>& states_;
  CorrectionOptions options_;
  base::Progress* progress_;
  std::vector<std::size_t> fold_;
  std::size_t motions_ = 0;
};

std::vector<double> chosen(const std::vector<double>& values, const std::vector<bool>& which) {
  std::vector<double> some;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (which[k]) some.push_back(values[k]);
  return some;
}

std::vector<bool> countingOf(const CleaningReport& report) {
  std::vector<bool> counts;
  for (const Reason reason : report.reason) counts.push_back(reason == Reason::kNone);
  return counts;
}

/// Are so many of the states [begin, end) out of place that all of them go?
bool goesWhole(const std::vector<Reason>& reason, std::size_t begin, std::size_t end, double most) {
  std::size_t gone = 0;
  for (std::size_t k = begin; k < end; ++k) gone += misplaced(reason[k]);
  return static_cast<double>(gone) > most * static_cast<double>(end - begin);
}

/// Of trajectories that went as a whole: all of it, where few enough states are out of place now, or nothing.
void decideTrajectories(const std::vector<State>& states, const CleaningReport& cleaned, double most,
                        std::vector<Reason>& reason) {
  for (std::size_t begin = 0, end = 0; begin < states.size(); begin = end) {
    while (end < states.size() && states[end].motion == states[begin].motion) ++end;
    if (!goesWhole(cleaned.reason, begin, end, most)) continue;
    const bool stays_out = goesWhole(reason, begin, end, most);
    for (std::size_t k = begin; k < end; ++k) {
      if (stays_out) reason[k] = cleaned.reason[k];
      if (!stays_out && reason[k] == Reason::kTrajectory) reason[k] = Reason::kNone;
    }
  }
}

/// Leaves `after` no more than `before`, of half of the states and of the worst?
bool noWorse(const std::vector<double>& before, const std::vector<double>& after) {
  constexpr std::array kShares = {0.5, kWorst};
  const std::vector<double> was = stats::quantiles(before, kShares), is = stats::quantiles(after, kShares);
  return is[0] <= (1.0 + kByChance) * was[0] && is[1] <= (1.0 + kByChance) * was[1];
}

/// Why each state does not count, with what can be learned readmitted.
std::vector<Reason> withReadmitted(const std::vector<State>& states, const CleaningReport& cleaned,
                                   double most, const Folds& folds, const base::ProgressPart& part) {
  const std::vector<bool> counts = countingOf(cleaned);
  const std::vector<double> left = folds.left(std::vector<bool>(states.size(), true), part.within(0.0, 0.33));
  if (left.empty()) return cleaned.reason;
  const double within = stats::quantile(chosen(left, counts), kSurely);
  CleaningReport more = cleaned;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (misplaced(cleaned.reason[k]) && left[k] <= within) more.reason[k] = Reason::kNone;
  decideTrajectories(states, cleaned, most, more.reason);
  if (more.reason == cleaned.reason) return cleaned.reason;
  const std::vector<double> before = folds.left(counts, part.within(0.33, 0.67)),
                            after = folds.left(countingOf(more), part.within(0.67, 1.0));
  if (before.empty() || after.empty()) return cleaned.reason;
  return noWorse(chosen(before, counts), chosen(after, counts)) ? more.reason : cleaned.reason;
}

}  // namespace

TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever) {
  TrainingStates training;
  training.states = kept(all, cleaned);
  training.offset = rigidOffset(pairsOf(training.states), lever);
  training.cleaning = std::move(cleaned);
  return training;
}

void readmit(TrainingStates& training, const std::vector<State>& all, const CleaningOptions& limits,
             const CorrectionOptions& options, base::Progress* progress, const base::ProgressPart& part) {
  CleaningReport& cleaning = training.cleaning;
  const Folds folds(all, options, progress);
  if (folds.motions() < kFewestMotions || training.states.empty() || training.states.size() == all.size())
    return;
  std::vector<Reason> reason = withReadmitted(all, cleaning, limits.most_rejected, folds, part);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (reason[k] != cleaning.reason[k]) cleaning.readmitted.push_back(cleaning.reason[k]);
  cleaning.reason = std::move(reason);
  training.states = kept(all, cleaning);
}

}  // namespace capstan::learning
