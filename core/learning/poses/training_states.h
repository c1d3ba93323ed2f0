#pragma once

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

namespace capstan::learning {

/// What became of states by weigh().
struct WeighingReport {
  bool weighed = false;           ///< not: too few motions, nothing left over, or cancelled
  std::vector<Reason> again;      ///< why cleaning had taken those that count again
  std::size_t down_weighted = 0;  ///< of those that count, of a w of all six below kDownWeighted
};

/// What a correction is learned from.
struct TrainingStates {
  CleaningReport cleaning;
  WeighingReport weighing;
  std::vector<State> states;                                 ///< that count
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid, of those that cleaning kept
};

/// Of all states those that cleaning kept, none doubted. At least one.
TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever);

/// Doubts states by how badly others tell them. Of what trial models of other motions leave of a state,
/// e (leftByOthers), and of the scatter s of each of its six among those that cleaning kept (by the median,
/// kScatterShare of the largest at least),
///     doubt = s² max(1/w − 1, 0),   w = (ν + n) / (ν + Σ e²/s²),
/// the sum over the n = 3 of the position for these, and over the 3 of the turn for those: the variance that
/// makes a noise of s² one of s² / w, w being the weights by which a multivariate t distribution of
/// ν = kFreedom degrees of freedom is fitted (Lange, Little and Taylor, Robust statistical modeling using the
/// t distribution, JASA 84 (1989)). It comes besides the noise that processes learn, which knows no
/// exclusions. Trial models take the motion of `options`, which has to be set: what history would explain is
/// not to be doubted. What cleaning found misplaced() is judged with the rest, and counts again from a w of
/// kAgain on, of all n = 6: a robot that does not follow a command, at a limit of a joint say, is out of
/// place in the same way each time, and an observation that is wrong is not. What is faster than `limits`
/// stays out, and the offset stays.
///
/// Models learned from all tell a first e, and models learned with its exclusions a second, which holds.
/// Where these leave more of what cleaning kept than models of that alone, by the median or by what is left
/// of kWorst of them (within kByChance), too much is wrong to learn from all, and e is what the latter leave.
/// Nothing changes with fewer than kFewestMotions, where nothing is left of half of the states, or when
/// cancelled.
void weigh(TrainingStates& training, const std::vector<State>& all, const CleaningOptions& limits,
           const CorrectionOptions& options, base::Progress* progress = nullptr,
           const base::ProgressPart& part = {});
inline constexpr double kFreedom = 4.0;
inline constexpr double kScatterShare = 0.01;  ///< turns by the lever
inline constexpr double kAgain = 0.03;         ///< all six by 7.4 of their scatters, or one by 18
inline constexpr double kDownWeighted = 0.5;
inline constexpr double kWorst = 0.9;
inline constexpr double kByChance = 0.05;  ///< by which trial models of much the same states differ

}  // namespace capstan::learning
