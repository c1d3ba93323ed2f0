#pragma once

#include <limits>
#include <vector>

#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {

/// Step of the normal equations with the damping, bounds kept: what would leave them stays at them.
/// Keeps references to `model` and `u`.
class BoundedStep {
 public:
  BoundedStep(const FitModel& model, const Eigen::VectorXd& u, Eigen::MatrixXd normal,
              Eigen::VectorXd gradient)
      : model_(model), u_(u), normal_(std::move(normal)), gradient_(std::move(gradient)) {}

  /// `bound`, where given: the numbers that stay at a bound.
  Eigen::VectorXd operator()(double damping, std::vector<bool>* bound = nullptr) const;

 private:
  Eigen::VectorXd solve(double damping, const std::vector<bool>& held) const;

  const FitModel& model_;
  const Eigen::VectorXd& u_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
};

/// Where a step led.
struct Trial {
  Eigen::VectorXd u, e;
  InitialStates initial;
  double objective = std::numeric_limits<double>::infinity();  ///< reached()
};

/// The best of some steps, simulated side by side; of a rigid drive with initial states that follow the
/// linearisation by more or less.
Trial bestOf(const FitData& data, const System& system, const BoundedStep& stepFor,
             const Weighting& weighting);

}  // namespace capstan::diagnosis
