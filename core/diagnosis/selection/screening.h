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
  double gain = 0.0;         ///< predicted reduction of the fit's objective, to first order
  double share = 0.0;        ///< predicted reduction of Σ (w e)², as a share of it
  double prior = 0.0;        ///< predicted gain of the log prior of the fit's parameters [nats]
};

/// Effects that this robot and these sensors can have and that `model` does not have. `only`: names of the
/// hypotheses to consider; empty: all.
std::vector<EffectCandidate> candidatesOf(const std::vector<Evidence>& recordings, const FitModel& model,
                                          const std::vector<std::string>& only);

/// Score tests of all candidates, the highest score first: the best start of each candidate, or of each of
/// its forms (the other joint of a coupling), from one of which no fit leads to another one. Each start
/// changes the fitted robot by a small size of the effect, or by the start itself if the effect has no small
/// size. The test predicts how far the objective of the fit, misfit and priors, falls while the fit's own
/// parameters follow: an effect can also let parameters return to their nominal values that had made up for
/// it. The cost is one simulation per start.
inline constexpr double kEventStep = 0.1;  ///< between instants of an event that are tried [s]
std::vector<ScoreTest> screen(const FitData& data, const Fit& fit, const Weighting& weighting,
                              const std::vector<EffectCandidate>& candidates);

}  // namespace capstan::diagnosis
