#pragma once

#include "core/learning/clean_states.h"
#include "core/learning/correction_model.h"

namespace capstan::learning {

/// Keeps states again that cleaning took, but that can be learned: a robot that does not follow a command, at
/// a limit of a joint say, is out of place in the same way each time, and a sight that is wrong is not.
///
/// Motions are dealt to kReadmissionFolds folds. A trialModel learned from all states of the other folds,
/// cleaned or not, corrects those of each. A state that cleaning took is kept again where what is left of it
/// (leftOf) is no more than what is left of kSurely of those that count, if models learned with all of these
/// leave no more of states that count than models without: median over motions held out, kWorth allowed.
/// Nothing changes with fewer than kFewestMotions, or when cancelled.
CleaningReport readmit(const std::vector<State>& states, CleaningReport cleaned,
                       const CorrectionOptions& options, base::Progress* progress = nullptr,
                       const base::ProgressPart& part = {});
inline constexpr std::size_t kReadmissionFolds = 3;
inline constexpr double kSurely = 0.95;

}  // namespace capstan::learning
