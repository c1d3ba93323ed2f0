#pragma once

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

namespace capstan::learning {

/// Result of weigh().
struct WeighingReport {
  bool weighed = false;           ///< false: too few motions, no residuals, or cancelled
  std::vector<Reason> again;      ///< why cleaning had rejected those that count again
  std::size_t down_weighted = 0;  ///< of those that count: w over all six below kDownWeighted
};

/// Training data of a correction.
struct TrainingStates {
  CleaningReport cleaning;
  WeighingReport weighing;
  std::vector<State> states;                                 ///< that count
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid, of the inliers of cleaning
};

/// The inliers of cleaning, none down-weighted. At least one.
TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever);

/// Down-weights states by how poorly others predict them. With e the residual of a state under trial models
/// of other motions (leftByOthers), and s the scale of each of its six components among the inliers of
/// cleaning (by the median, kScatterShare of the largest at least), a state has the extra variance
///     s² max(1/w − 1, 0),   w = (ν + n) / (ν + Σ e²/s²),
/// the sum over the n = 3 components of its position or of its rotation. A noise variance of s² becomes
/// s² / w, where w are the weights by which a multivariate t distribution of ν = kFreedom degrees of freedom
/// is fitted (Lange, Little and Taylor, Robust statistical modeling using the t distribution, JASA 84
/// (1989)). The variance is added to the noise that processes learn, which knows no outliers. Trial models
/// have the motion features of `options`, which must be set: errors that history explains are not outliers.
/// States that cleaning rejected as misplaced(), or with their trajectory, are judged too, and count again
/// from w = kAgain on, over all n = 6: a robot that stops at a joint limit is displaced in the same way each
/// time, a wrong observation is not. States that are tooFast() stay rejected, and the rigid offset does not
/// change. The residuals e are computed twice: first from trial models of all states with equal weights, then
/// from models with the weights of the first pass; the second result is final. If these models predict the
/// inliers of cleaning worse than models of the inliers alone (by the median or by the kWorst quantile,
/// beyond kByChance), there are too many outliers, and e is that of the inliers' models. Nothing changes with
/// fewer than kFewestMotions, where half of the states have no residual, or when cancelled.
void weigh(TrainingStates& training, const std::vector<State>& all, const CorrectionOptions& options,
           base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr double kFreedom = 4.0;
inline constexpr double kScatterShare = 0.01;  ///< rotations by the lever
inline constexpr double kAgain = 0.03;         ///< all six by 7.4 of their scatters, or one by 18
inline constexpr double kDownWeighted = 0.5;
inline constexpr double kWorst = 0.9;
inline constexpr double kByChance = 0.05;  ///< by which trial models of much the same states differ

}  // namespace capstan::learning
