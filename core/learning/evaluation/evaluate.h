#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/names.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/evaluation/stated_errors.h"
#include "core/learning/model/learn.h"

/// How large the errors of a learned correction are on trajectories that it was not learned from.
namespace capstan::learning {

/// How far a correction goes.
enum class CorrectionStep { kUncorrected, kOffset, kCorrected };
inline constexpr std::size_t kCorrectionSteps = 3;
using StepErrors = std::array<PoseErrors, kCorrectionSteps>;  ///< by CorrectionStep

struct Evaluation {
  std::size_t states = 0, clean_states = 0;
  StepErrors all, clean;  ///< of all states, and of those that the limits found in training keep
  StatedErrors stated;    ///< of the clean ones; none of a rigid offset, which states no σ
};

/// Errors of `learned`, which was learned with `options`, on `states` of other motions.
Evaluation evaluate(const LearningReport& learned, const std::vector<State>& states,
                    const LearningOptions& options);

/// What is held out of training.
struct HoldOut {
  double share = 0.2;  ///< of the trajectories: the paper's
  std::uint64_t seed = 1;
};

struct HeldOutEvaluation {
  std::vector<bool> held;                     ///< by motion: held out
  std::size_t motions = 0, motions_held = 0;  ///< of those that have states
  std::optional<LearningReport> learned;      ///< from the motions that are not held out; none: cancelled
  Evaluation test;                            ///< of the motions that are
  std::vector<Eigen::Isometry3d> corrected;   ///< of every state given
  bool cancelled = false;
};

/// Holds trajectories out, learns from the others as learnPrepared() does, and evaluates on those held out.
/// base::InputError as learnPrepared(), and where nothing is left to hold out or to learn from.
HeldOutEvaluation evaluateHeldOut(const PreparedStates& prepared, const LearningOptions& options,
                                  const HoldOut& hold_out, base::Progress* progress = nullptr,
                                  const base::ProgressPart& part = {});

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::CorrectionStep> {
  using S = capstan::learning::CorrectionStep;
  static constexpr std::array value = {std::pair{S::kUncorrected, "none"}, std::pair{S::kOffset, "offset"},
                                       std::pair{S::kCorrected, "corrected"}};
};
