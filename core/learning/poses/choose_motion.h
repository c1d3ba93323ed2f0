#pragma once

#include "core/learning/model/trial_model.h"

namespace capstan::learning {

/// Chooses the motion features of a correction: velocity, or velocity and history (the last kSpans). A
/// trialModel with each is learned from 4/5 of the motions and evaluated on the others. History is chosen if
/// its median of ‖Δt‖ + lever · angle is lower by the share kWorth. Velocity is chosen with fewer than
/// kFewestMotions or if cancelled.
Motion chooseMotion(const std::vector<State>& states, const CorrectionOptions& options,
                    base::Progress* progress = nullptr, const base::ProgressPart& part = {});

}  // namespace capstan::learning
