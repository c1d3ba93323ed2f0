#pragma once

#include "core/learning/clean_states.h"
#include "core/learning/correction_model.h"

namespace capstan::learning {

/// What a correction is learned from.
struct TrainingStates {
  CleaningReport cleaning;
  std::vector<State> states;                                 ///< that count
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid, of those that cleaning kept
};

/// Of all states those that cleaning kept, of one weight. At least one.
TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever);

/// Weighs states by how well others tell them: of what trial models of other motions leave of a state
/// (leftByOthers), e, and of the median s of those that cleaning kept, that of Student's t distribution with
/// kFreedom degrees of freedom (Lange, Little and Taylor, Robust statistical modeling using the t
/// distribution, JASA 84 (1989)),
///     weight = (ν + 1) / (ν + e²/s²).
/// What cleaning found misplaced() is weighed with the rest, and counts again from kLeastWeight on: a robot
/// that does not follow a command, at a limit of a joint say, is out of place in the same way each time, and
/// a sight that is wrong is not. Speeds that are wrong stay out, and the offset stays.
///
/// Models learned from all tell a first e, and models learned with its weights a second, which holds. Where
/// these leave more of what cleaning kept than models of that alone, by the median or by what is left of
/// kWorst of them (within kByChance), too much is wrong to learn from all, and e is what the latter leave.
/// Nothing changes with fewer than kFewestMotions, or when cancelled.
void weigh(TrainingStates& training, const std::vector<State>& all, const CorrectionOptions& options,
           base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr double kFreedom = 4.0;
inline constexpr double kLeastWeight = 0.1;  ///< seven medians off
inline constexpr double kWorst = 0.9;
inline constexpr double kByChance = 0.05;  ///< by which trial models of much the same states differ

}  // namespace capstan::learning
