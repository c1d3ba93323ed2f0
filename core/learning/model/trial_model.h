#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// A model from few points that shows soon what is worth learning: kTrialPoints states for its
/// hyperparameters, as many inducing points, σ as they are.
CorrectionModel trialModel(const std::vector<State>& states, CorrectionOptions options,
                           base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr Eigen::Index kTrialPoints = 500;
/// What trial models must differ by to decide something, and how many motions it takes.
inline constexpr double kWorth = 0.02;
inline constexpr std::size_t kFewestMotions = 10;

/// leftOf() of each state, by trial models of the motions of other folds, of which there are kFolds, learned
/// from those that count. Empty: cancelled, or too few states to learn from.
std::vector<Vector6d> leftByOthers(const std::vector<State>& states, const std::vector<bool>& counts,
                                   const CorrectionOptions& options, base::Progress* progress = nullptr,
                                   const base::ProgressPart& part = {});
inline constexpr std::size_t kFolds = 3;

/// Residual of each state under a model, in its outputs (PoseFeatures::correction): of the position
/// [m], and of the rotation [rad].
std::vector<Vector6d> leftOf(const CorrectionModel& model, const std::vector<State>& states);
/// ‖Δt‖ + lever · angle of each [m].
std::vector<double> sizesOf(const std::vector<Vector6d>& left, double lever);

}  // namespace capstan::learning
