#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

/// Learning curve: error of a correction as a function of the number of training states (GPR paper, section
/// V-B 2 and figure 5).
namespace capstan::learning {

struct LearningCurveOptions {
  std::vector<double> shares = {0.025, 0.05, 0.1, 0.25, 0.5, 1.0};  ///< shares of the training states
  double test_share = 0.2;  ///< share of the trajectories that is held out
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction;
  std::uint64_t seed = 1;
};

struct LearningCurvePoint {
  double share = 0.0;
  std::size_t states = 0;   ///< number of training states
  CorrectionErrors errors;  ///< errors of clean held-out states
};

struct LearningCurve {
  std::vector<LearningCurvePoint> points;  ///< in the order of increasing shares
  CorrectionErrors none, offset;  ///< errors without correction, and with the offset of all training states
  std::size_t motions_held = 0;
  bool cancelled = false;  ///< `points` has those that were completed
};

/// Trains on random shares of the clean training states (none down-weighted), without replacement, and
/// computes the errors of the same clean held-out states. A share has at least learning::kFewestStates
/// states. Throws base::InputError as CorrectionModel::trained().
LearningCurve learningCurve(const std::vector<learning::State>& states, const LearningCurveOptions& options,
                            base::Progress* progress = nullptr);

}  // namespace capstan::learning
