#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/effect_set.h"

namespace capstan::diagnosis {

/// An effect that a score test speaks for, and where its refit should start.
struct ScoreTest {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;       ///< from 1; 0: whole arm
  EffectStart start;   ///< with the size that the test suggests
  double gain = 0.0;   ///< by which Σ (w e)² would fall, were the simulation linear
  double share = 0.0;  ///< of the Σ (w e)² that the fit leaves
};

/// Effects that this robot and these sensors can have and that `model` has not; `only`: names of hypotheses, empty: all.
std::vector<EffectCandidate> candidatesOf(const std::vector<Evidence>& recordings, const FitModel& model,
                                          const std::vector<std::string>& only);

/// Score tests on sensitivities: each start of each candidate changes the fitted robot by a little (or, where
/// an effect has no little, by the start itself), and the response, less what the fit's own parameters could
/// do, is projected on the residual. Best start of each candidate, highest score first. Cost: one simulation
/// a start.
std::vector<ScoreTest> screen(const FitData& data, const Fit& fit, const Weighting& weighting,
                              const std::vector<EffectCandidate>& candidates);

}  // namespace capstan::diagnosis
