#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/evaluation/stated_errors.h"
#include "core/learning/poses/training_states.h"

/// One model, and how far it is off on trajectories that it did not learn from.
namespace capstan::learning {

/// How far a correction goes.
enum class CorrectionStep { kUncorrected, kOffset, kCorrected };
inline constexpr std::size_t kCorrectionSteps = 3;

struct CorrectionTrialOptions {
  double test_share = 0.2;  ///< of the trajectories: the paper's
  learning::CleaningOptions cleaning;
  bool weigh = true;  ///< states, by how well others tell them
  learning::CorrectionOptions correction;
  std::uint64_t seed = 1;
};

using StepErrors = std::array<PoseErrors, kCorrectionSteps>;  ///< by CorrectionStep

struct CorrectionTrial {
  std::vector<bool> held;                     ///< by motion: held out
  std::size_t motions = 0, motions_held = 0;  ///< of those that have states
  std::vector<learning::State> learned;       ///< states that the model was trained on
  learning::WeighingReport weighing;          ///< of them
  StepErrors clean, dirty;  ///< of held-out states: those that cleaning keeps, and all of them
  StatedErrors stated;      ///< of the clean ones
  std::optional<learning::CorrectionModel> model;  ///< has learned the held-out ones, too, after the errors
  std::vector<Eigen::Isometry3d> corrected;  ///< of every state given, before the model learned held-out ones
  bool cancelled = false;                    ///< there is no model
};

/// Holds trajectories out, cleans and weighs the others, trains on them, and takes the
/// errors of those held out: as seen, with the rigid offset, corrected. Then the model learns what is clean
/// of them as well. base::InputError as CorrectionModel::trained(), and where nothing is left to hold out.
CorrectionTrial correctionTrial(const std::vector<learning::State>& states,
                                const CorrectionTrialOptions& options, base::Progress* progress = nullptr);

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::CorrectionStep> {
  using S = capstan::learning::CorrectionStep;
  static constexpr std::array value = {std::pair{S::kUncorrected, "none"}, std::pair{S::kOffset, "offset"},
                                       std::pair{S::kCorrected, "corrected"}};
};
