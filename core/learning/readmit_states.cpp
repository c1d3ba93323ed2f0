#include "core/learning/readmit_states.h"

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

}  // namespace

CleaningReport readmit(const std::vector<State>& states, CleaningReport cleaned,
                       const CorrectionOptions& options, base::Progress* progress,
                       const base::ProgressPart& part) {
  const Folds folds(states, options, progress);
  std::vector<bool> counts;
  for (const Reason reason : cleaned.reason) counts.push_back(reason == Reason::kNone);
  if (folds.motions() < kFewestMotions || cleaned.kept() == 0 || cleaned.kept() == states.size())
    return cleaned;
  const std::vector<double> left = folds.left(std::vector<bool>(states.size(), true), part.within(0.0, 0.33));
  if (left.empty()) return cleaned;
  const double within = stats::quantile(chosen(left, counts), kSurely);
  CleaningReport more = cleaned;
  std::vector<bool> with = counts;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (counts[k] || left[k] > within) continue;
    more.reason[k] = Reason::kNone;
    with[k] = true;
    ++more.readmitted;
  }
  if (more.readmitted == 0) return cleaned;
  const std::vector<double> without_them = folds.left(counts, part.within(0.33, 0.67)),
                            with_them = folds.left(with, part.within(0.67, 1.0));
  if (without_them.empty() || with_them.empty()) return cleaned;
  const double before = stats::median(chosen(without_them, counts)),
               after = stats::median(chosen(with_them, counts));
  return after <= (1.0 + kWorth) * before ? more : cleaned;
}

}  // namespace capstan::learning
