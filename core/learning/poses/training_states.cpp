#include "core/learning/poses/training_states.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/learning/model/trial_model.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

bool mayCount(Reason reason) {
  return reason == Reason::kNone || reason == Reason::kTrajectory || misplaced(reason);
}

/// Sizes of the inliers of cleaning.
std::vector<double> ofKept(const std::vector<double>& sizes, const std::vector<bool>& kept) {
  std::vector<double> some;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    if (kept[k]) some.push_back(sizes[k]);
  return some;
}

/// Scale of each of the six components: standard deviation of a normal distribution with the median of |left|
/// among the inliers.
Vector6d scatterOf(const std::vector<Vector6d>& left, const std::vector<bool>& kept) {
  constexpr double kOfNormal = 1.4826;
  Vector6d arms, scatter;
  arms << 1.0, 1.0, 1.0, kLever, kLever, kLever;
  for (Eigen::Index i = 0; i < 6; ++i) {
    std::vector<double> sizes;
    for (const Vector6d& one : left) sizes.push_back(arms[i] * std::abs(one[i]));
    scatter[i] = kOfNormal * stats::median(ofKept(sizes, kept));
  }
  return scatter.cwiseMax(kScatterShare * scatter.maxCoeff()).cwiseQuotient(arms);
}

/// Weights of states from their residuals.
class Judgement {
 public:
  Judgement(std::vector<Vector6d> left, std::vector<bool> kept)
      : left_(std::move(left)), kept_(std::move(kept)) {
    if (!left_.empty()) scatter_ = scatterOf(left_, kept_);
  }

  /// False: cancelled, or the median residual is 0.
  bool made() const { return scatter_.maxCoeff() > 0.0; }
  /// Weight over position and rotation together.
  double weight(std::size_t k) const { return weightOf(inScatters(k)); }
  bool counts(std::size_t k) const { return kept_[k] || weight(k) >= kAgain; }
  Vector6d extraVariance(std::size_t k) const {
    const Vector6d far = inScatters(k);
    Vector6d variance;
    variance.head<3>().setConstant(1.0 / weightOf(far.head<3>()) - 1.0);
    variance.tail<3>().setConstant(1.0 / weightOf(far.tail<3>()) - 1.0);
    return variance.cwiseMax(0.0).cwiseProduct(scatter_.cwiseAbs2());
  }

 private:
  Vector6d inScatters(std::size_t k) const { return left_[k].cwiseQuotient(scatter_); }
  static double weightOf(const Eigen::VectorXd& far) {
    return (kFreedom + static_cast<double>(far.size())) / (kFreedom + far.squaredNorm());
  }

  std::vector<Vector6d> left_;
  std::vector<bool> kept_;
  Vector6d scatter_ = Vector6d::Zero();
};

/// True if the residuals `after` are not larger than `before`, by the median and by the kWorst quantile.
bool noWorse(const std::vector<double>& before, const std::vector<double>& after) {
  constexpr std::array kShares = {0.5, kWorst};
  const std::vector<double> was = stats::quantiles(before, kShares), is = stats::quantiles(after, kShares);
  return is[0] <= (1.0 + kByChance) * was[0] && is[1] <= (1.0 + kByChance) * was[1];
}

/// Residual of each state under down-weighted models of all states, or under models of the inliers if these
/// are better. Empty: cancelled, or too few states.
std::vector<Vector6d> residualOfEach(std::vector<State> states, const std::vector<bool>& kept,
                                     const CorrectionOptions& options, base::Progress* progress,
                                     const base::ProgressPart& part) {
  std::vector<bool> counts(states.size(), true);
  const Judgement by_all(leftByOthers(states, counts, options, progress, part.within(0.0, 0.33)), kept);
  if (progress && progress->cancelled()) return {};
  std::vector<Vector6d> by_kept = leftByOthers(states, kept, options, progress, part.within(0.33, 0.67));
  if (by_kept.empty() || !by_all.made()) return by_kept;
  for (std::size_t k = 0; k < states.size(); ++k) {
    counts[k] = by_all.counts(k);
    states[k].extra_variance = by_all.extraVariance(k);
  }
  std::vector<Vector6d> by_down_weighted =
      leftByOthers(states, counts, options, progress, part.within(0.67, 1.0));
  if (by_down_weighted.empty()) return {};
  const auto ofKeptBy = [&](const std::vector<Vector6d>& left) {
    return ofKept(sizesOf(left, kLever), kept);
  };
  return noWorse(ofKeptBy(by_kept), ofKeptBy(by_down_weighted)) ? by_down_weighted : by_kept;
}

}  // namespace

TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned) {
  TrainingStates training;
  training.states = kept(all, cleaned);
  training.offset = rigidOffset(pairsOf(training.states));
  training.cleaning = std::move(cleaned);
  return training;
}

void weigh(TrainingStates& training, const std::vector<State>& all, const CorrectionOptions& options,
           base::Progress* progress, const base::ProgressPart& part) {
  CleaningReport& cleaning = training.cleaning;
  std::vector<State> some;
  std::vector<std::size_t> places;  // indices in `all`
  std::vector<bool> kept;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!mayCount(cleaning.reason[k]) || tooFast(all[k])) continue;
    some.push_back(all[k]);
    places.push_back(k);
    kept.push_back(cleaning.reason[k] == Reason::kNone);
  }
  if (some.empty() || motionPlaces(some).back() + 1 < kFewestMotions) return;
  CorrectionOptions own = options;
  own.offset = training.offset;
  const Judgement judgement(residualOfEach(some, kept, own, progress, part), kept);
  if (!judgement.made()) return;
  training.states.clear();
  for (std::size_t k = 0; k < some.size(); ++k) {
    if (!judgement.counts(k)) continue;
    Reason& reason = cleaning.reason[places[k]];
    if (!kept[k]) training.weighing.again.push_back(std::exchange(reason, Reason::kNone));
    training.weighing.down_weighted += judgement.weight(k) < kDownWeighted;
    some[k].extra_variance = judgement.extraVariance(k);
    training.states.push_back(some[k]);
  }
  training.weighing.weighed = true;
}

}  // namespace capstan::learning
