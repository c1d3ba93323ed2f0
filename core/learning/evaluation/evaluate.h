#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/names.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/evaluation/stated_errors.h"
#include "core/learning/model/learn.h"

/// Evaluation of a learned correction on trajectories that are not in its training data.
namespace capstan::learning {

/// Stages of a correction.
enum class CorrectionStep { kUncorrected, kOffset, kCorrected };
inline constexpr std::size_t kCorrectionSteps = 3;
using StepErrors = std::array<PoseErrors, kCorrectionSteps>;  ///< by CorrectionStep

struct Evaluation {
  std::size_t states = 0, clean_states = 0;
  StepErrors all, clean;  ///< errors of all states, and of those within the limits found in training
  StatedErrors stated;    ///< of the clean states; empty for a rigid offset, which states no σ
};

/// Errors of `learned` on `states` of other motions; `options` are those with which it was learned.
Evaluation evaluate(const LearningReport& learned, const std::vector<State>& states,
                    const LearningOptions& options);

/// Selection of the hold-out set.
struct HoldOut {
  double share = 0.2;  ///< share of the trajectories; as in the paper
  std::uint64_t seed = 1;
};

struct HeldOutEvaluation {
  std::vector<bool> held;                     ///< by motion: true if held out
  std::size_t motions = 0, motions_held = 0;  ///< number of motions with states, and those held out
  std::optional<LearningReport> learned;  ///< learned from the motions that are not held out; none: cancelled
  Evaluation test;                        ///< evaluation on the motions held out
  std::vector<Eigen::Isometry3d> corrected;  ///< corrected pose of every given state
  bool cancelled = false;
};

/// Holds trajectories out, learns from the others with learnPrepared(), and evaluates on those held out.
/// Throws base::InputError as learnPrepared(), and if no motion remains for training or for the hold-out set.
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
