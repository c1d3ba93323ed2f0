#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

/// How many states a correction has to learn from (GPR paper, section V-B 2 and figure 5).
namespace capstan::learning {

struct LearningCurveOptions {
  std::vector<double> shares = {0.025, 0.05, 0.1, 0.25, 0.5, 1.0};  ///< of the training states
  double test_share = 0.2;                                          ///< of the trajectories
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction;
  std::uint64_t seed = 1;
};

struct LearningCurvePoint {
  double share = 0.0;
  std::size_t states = 0;   ///< learned from
  CorrectionErrors errors;  ///< of clean held-out states
};

struct LearningCurve {
  std::vector<LearningCurvePoint> points;  ///< rising
  CorrectionErrors none, offset;           ///< uncorrected, and with the offset of all training states
  std::size_t motions_held = 0;
  bool cancelled = false;  ///< points that were done are there
};

/// Trains on random shares of the training states that cleaning keeps (none down-weighted), without
/// replacement, and takes the errors of the same clean held-out states. A share of fewer than
/// learning::kFewestStates is that many. base::InputError as CorrectionModel::trained().
LearningCurve learningCurve(const std::vector<learning::State>& states, const LearningCurveOptions& options,
                            base::Progress* progress = nullptr);

}  // namespace capstan::learning
