#pragma once

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

namespace capstan::learning {

/// Report of weigh().
struct WeighingReport {
  bool weighed = false;           ///< false: not weighted (too few motions, no residuals, or cancelled)
  std::vector<Reason> again;      ///< reason for which cleaning had rejected each state that is used again
  std::size_t down_weighted = 0;  ///< number of training states with w (n = 6) below kDownWeighted
};

/// Training data of a correction.
struct TrainingStates {
  CleaningReport cleaning;
  WeighingReport weighing;
  std::vector<State> states;                                 ///< states used for training
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid offset of the inliers of cleaning
};

/// Training states without weights: the inliers of cleaning, at least one.
TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned);

/// Down-weights states that models of other motions predict poorly. e is the residual of a state under trial
/// models of other motions (leftByOthers). s is the scale of each of its six components among the inliers of
/// cleaning (by the median, at least kScatterShare of the largest scale). The extra variance of a state is
///     s² max(1/w − 1, 0),   w = (ν + n) / (ν + Σ e²/s²),
/// with the sum over the n = 3 components of its position or of its rotation. A noise variance of s² becomes
/// s² / w, where w are the weights for fitting a multivariate t distribution with ν = kFreedom degrees of
/// freedom (Lange, Little and Taylor, Robust statistical modeling using the t distribution, JASA 84 (1989)).
/// The extra variance is added to the noise variance that processes learn, which does not model outliers.
/// Trial models use the motion features of `options`, which must be set, because errors that history explains
/// are not outliers. States that cleaning rejected as misplaced() or with their trajectory are tested too,
/// and are used again if w over all n = 6 is at least kAgain: a robot that stops at a joint limit is
/// displaced in the same way each time, but a wrong observation is not. States that are tooFast() stay
/// rejected, and the rigid offset does not change. The residuals e are computed twice: first from trial
/// models of all states with equal weights, then from models with the weights of the first pass; the second
/// result is final. If these models predict the inliers of cleaning worse than models of the inliers alone
/// (by the median or the kWorst quantile, by more than kByChance), there are too many outliers, and e is
/// taken from the models of the inliers. Nothing changes with fewer than kFewestMotions motions, if the
/// median residual is 0, or when cancelled.
void weigh(TrainingStates& training, const std::vector<State>& all, const CorrectionOptions& options,
           base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr double kFreedom = 4.0;
inline constexpr double kScatterShare = 0.01;  ///< smallest scale by largest; rotations by the lever
inline constexpr double kAgain = 0.03;         ///< reached at e = 7.4 s in all six components, or 18 s in one
inline constexpr double kDownWeighted = 0.5;
inline constexpr double kWorst = 0.9;
inline constexpr double kByChance = 0.05;  ///< difference of similar trial models by chance

}  // namespace capstan::learning
