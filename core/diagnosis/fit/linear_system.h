#pragma once

#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// A fit linearised at its numbers and initial states, and what the nuisances of each segment take off the
/// residual.
struct System {
  Fit at;
  std::vector<Eigen::MatrixXd> off_residual;  ///< by stretch: coefficients of e
  double objective = 0.0;                     ///< as simulated: see reached()
};

System systemAt(const FitData& data, const FitModel& model, const Eigen::VectorXd& u,
                const InitialStates& initial, const Weighting& weighting, const Fit* known = nullptr);

/// What a step is judged by. Initial states are where the simulation began, not where its linearisation would
/// put them, which may be far from what friction at rest makes of it; encoder zeros are linear.
double reached(const FitData& data, const FitModel& model, const Eigen::VectorXd& u,
               const Eigen::VectorXd& simulated, const Eigen::VectorXd& removed, const Weighting& weighting);

/// Precision of the nuisances' own estimates: initial positions are known to some counts of the encoder,
/// speeds to a tenth of the largest, those of whole recordings' starts to the encoder's value (a change of
/// speed there would be a step for all that follows); encoder zeros not at all.
Eigen::VectorXd nuisancePrecision(const FitData& data, const robot::ChainModel& model);

/// Coefficients of each segment's nuisances that explain the columns of x best, subtracted from x in place.
std::vector<Eigen::MatrixXd> takeOffNuisances(const FitData& data, const Eigen::MatrixXd& nuisance,
                                              const Eigen::VectorXd& precision,
                                              const Eigen::VectorXd& weights, Eigen::Ref<Eigen::MatrixXd> x);

Eigen::VectorXd priorPrecision(const FitModel& model);

/// Initial states as a step of u moves them.
InitialStates following(const FitData& data, const Fit& at, const Eigen::VectorXd& step);

/// Of rigid drives: calls with recording, window and stretch of each window that has numbers.
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
