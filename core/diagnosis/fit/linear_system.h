#pragma once

#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Fit linearised at its parameters and initial states, with the nuisances that were subtracted from the
/// residual.
struct System {
  Fit at;
  std::vector<Eigen::MatrixXd> off_residual;  ///< coefficients of the nuisances of e, by segment
  double objective = 0.0;                     ///< reached()
};

/// Model, parameters and initial states of a linearisation.
struct LinearisationPoint {
  const FitModel* model = nullptr;
  Eigen::VectorXd u;
  InitialStates initial;
  const Weighting* weighting = nullptr;
  const Fit* known = nullptr;  ///< FitOptions::known
};

/// Linearises each model at its point. The robots of all points are simulated in parallel.
std::vector<System> systemsAt(const FitData& data, const std::vector<LinearisationPoint>& points);

/// Objective that a step is judged by. For rigid drives it uses the residuals `simulated` from the actual
/// initial states, because the linearised ones can be far off with static friction. For cable drives it uses
/// `removed`, from which the encoder zeros are subtracted, because these are linear.
double reached(const FitData& data, const FitModel& model, const Eigen::VectorXd& u,
               const Eigen::VectorXd& simulated, const Eigen::VectorXd& removed, const Weighting& weighting);

/// Prior precision 1/σ² of the nuisances. For initial positions, σ is four times the encoder's noise. For
/// initial speeds it is 1/200 of the largest speed; if a recording is simulated as a whole, it is at most
/// the encoder's noise × 500/s, because a wrong speed there affects the whole recording. Encoder zeros have
/// no prior.
Eigen::VectorXd nuisancePrecision(const FitData& data, const robot::ChainModel& model);

/// Fits each segment's nuisances to the columns of x by least squares and subtracts them from x in place.
/// Returns their coefficients, one matrix per segment.
std::vector<Eigen::MatrixXd> takeOffNuisances(const FitData& data, const Eigen::MatrixXd& nuisance,
                                              const Eigen::VectorXd& precision,
                                              const Eigen::VectorXd& weights, Eigen::Ref<Eigen::MatrixXd> x);

/// Prior precision 1 / prior² of each parameter u.
Eigen::VectorXd priorPrecision(const FitModel& model);

/// Initial states after a step of u, by the linearisation.
InitialStates following(const FitData& data, const Fit& at, const Eigen::VectorXd& step);

/// Calls use(recording, window, segment) for each window with readings, for rigid drives.
template <typename Use>
void forSegments(const FitData& data, const Use& use) {
  std::size_t segment = 0;
  for (int r = 0; r < data.recordings(); ++r) {
    const Compared& compared = data.simulation(r).compared();
    for (std::size_t w = 0; w + 1 < compared.window_begin.size(); ++w)
      if (compared.window_begin[w] != compared.window_begin[w + 1])
        use(static_cast<std::size_t>(r), static_cast<Eigen::Index>(w), segment++);
  }
}

}  // namespace capstan::diagnosis
