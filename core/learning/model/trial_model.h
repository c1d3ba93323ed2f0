#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// Trains a model quickly from few points, for comparisons: one member, kTrialPoints states for the
/// hyperparameters, as many inducing points, σ not calibrated.
CorrectionModel trialModel(const std::vector<State>& states, CorrectionOptions options,
                           base::Progress* progress = nullptr, const base::ProgressPart& part = {});
inline constexpr Eigen::Index kTrialPoints = 500;
/// Relative difference of trial models that decides a comparison, and the smallest number of motions for it.
inline constexpr double kWorth = 0.02;
inline constexpr std::size_t kFewestMotions = 10;

/// Cross-validated residual leftOf() of each state, from a trial model of the other folds (kFolds folds of
/// motions). Models are learned from the states with `counts`. Empty: cancelled, or too few states.
std::vector<Vector6d> leftByOthers(const std::vector<State>& states, const std::vector<bool>& counts,
                                   const CorrectionOptions& options, base::Progress* progress = nullptr,
                                   const base::ProgressPart& part = {});
inline constexpr std::size_t kFolds = 3;

/// Residual of each state under a model, as PoseFeatures::correction: of the position [m], then of the
/// rotation [rad].
std::vector<Vector6d> leftOf(const CorrectionModel& model, const std::vector<State>& states);
/// Size ‖Δt‖ + lever · angle of each residual [m].
std::vector<double> sizesOf(const std::vector<Vector6d>& left, double lever);

}  // namespace capstan::learning
