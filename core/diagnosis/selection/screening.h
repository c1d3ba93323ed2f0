#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/effect_set.h"

namespace capstan::diagnosis {

/// Score test of one candidate effect, and the start of its refit.
struct ScoreTest {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;             ///< joint, from 1; 0: whole arm
  EffectStart start;         ///< start with the size that the test predicts
  std::vector<double> from;  ///< values of the start from which the prediction goes out
  Eigen::VectorXd follow;    ///< changes of the fit's parameters that go with `start`, to first order
  double gain = 0.0;         ///< predicted reduction of Σ (w e)², to first order
  double share = 0.0;        ///< gain divided by Σ (w e)² of the fit
};

/// Effects that this robot and these sensors can have and that `model` does not have. `only`: names of the
/// hypotheses to consider; empty: all.
std::vector<EffectCandidate> candidatesOf(const std::vector<Evidence>& recordings, const FitModel& model,
                                          const std::vector<std::string>& only);

/// Score tests of all candidates, the highest score first: the best start of each candidate, or of each of
/// its forms (the other joint of a coupling), from one of which no fit leads to another one. Each start
/// changes the fitted robot by a small size of the effect, or by the start itself if the effect has no small
/// size. The change of the readings, without the part that the fit's own parameters could also produce, is
/// projected on the residual. The cost is one simulation per start.
inline constexpr double kEventStep = 0.1;  ///< between instants of an event that are tried [s]
std::vector<ScoreTest> screen(const FitData& data, const Fit& fit, const Weighting& weighting,
                              const std::vector<EffectCandidate>& candidates);

}  // namespace capstan::diagnosis
