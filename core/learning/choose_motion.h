#pragma once

#include "core/learning/correction_model.h"

namespace capstan::learning {

/// What a correction should be told of the motion besides the pose: its velocity, or also how it moved in the
/// last kSpans. A small model of each is learned from four fifths of the motions (kTrialPoints states for its
/// hyperparameters, as many inducing points) and corrects the other fifth; history is chosen where the median
/// of ‖Δt‖ + lever · angle is less by kWorth. Fewer than kFewestMotions, or cancelled: velocity.
Motion chooseMotion(const std::vector<State>& states, const CorrectionOptions& options,
                    base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr Eigen::Index kTrialPoints = 500;
inline constexpr double kWorth = 0.02;
inline constexpr std::size_t kFewestMotions = 10;

}  // namespace capstan::learning
