#pragma once

#include "core/learning/model/trial_model.h"

namespace capstan::learning {

/// Motion features of a correction besides the pose: its velocity, or also how it moved in the
/// last kSpans. A trialModel of each is learned from four fifths of the motions and corrects the other fifth;
/// history is chosen where the median of ‖Δt‖ + lever · angle is less by kWorth. Fewer than kFewestMotions,
/// or cancelled: velocity.
Motion chooseMotion(const std::vector<State>& states, const CorrectionOptions& options,
                    base::Progress* progress = nullptr, const base::ProgressPart& part = {});

}  // namespace capstan::learning
