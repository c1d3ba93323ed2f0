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

/// Of all states those that cleaning kept. At least one.
TrainingStates trainingStates(const std::vector<State>& all, CleaningReport cleaned, double lever);

/// Takes in of what cleaning found misplaced() what can be learned all the same: a robot that does not follow
/// a command, at a limit of a joint say, is out of place in the same way each time, and a sight that is wrong
/// is not. The offset stays.
///
/// Motions are dealt to kReadmissionFolds folds. A trialModel learned from all states of the other folds,
/// cleaned or not, corrects those of each. A misplaced state counts again where what is left of it (leftOf)
/// is no more than what is left of kSurely of those that count; a trajectory that went as a whole comes back
/// as a whole or not at all, by `limits.most_rejected`. Nothing is readmitted if models learned with all of
/// these leave more of states that count than models without, by their median or by what is left of kWorst of
/// them (over motions held out, within kByChance); nor of fewer than kFewestMotions, nor when cancelled.
void readmit(TrainingStates& training, const std::vector<State>& all, const CleaningOptions& limits,
             const CorrectionOptions& options, base::Progress* progress = nullptr,
             const base::ProgressPart& part = {});
inline constexpr std::size_t kReadmissionFolds = 3;
inline constexpr double kSurely = 0.95, kWorst = 0.9;
inline constexpr double kByChance = 0.05;  ///< by which trial models of much the same states differ

}  // namespace capstan::learning
