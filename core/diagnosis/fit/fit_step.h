#pragma once

#include <limits>
#include <vector>

#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {

/// Step of the damped normal equations within the bounds: a parameter at a bound that would
/// leave it is held there. Keeps references to `model` and `u`.
class BoundedStep {
 public:
  BoundedStep(const FitModel& model, const Eigen::VectorXd& u, Eigen::MatrixXd normal,
              Eigen::VectorXd gradient)
      : model_(model), u_(u), normal_(std::move(normal)), gradient_(std::move(gradient)) {}

  /// Step for one damping. `bound`, if given, receives the parameters that a bound stops.
  Eigen::VectorXd operator()(double damping, std::vector<bool>* bound = nullptr) const;

 private:
  Eigen::VectorXd solve(double damping, const std::vector<bool>& held) const;

  const FitModel& model_;
  const Eigen::VectorXd& u_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
};

/// Result of one step.
struct Trial {
  Eigen::VectorXd u, e;
  InitialStates initial;
  double objective = std::numeric_limits<double>::infinity();  ///< by reached() (linear_system.h)
};

/// What a step of one fit starts from.
struct StepOrigin {
  const System* system = nullptr;
  const BoundedStep* stepFor = nullptr;
  const Weighting* weighting = nullptr;
  bool coarse = false;  ///< FitOptions::coarse
};

/// Best of several steps for each origin. The steps differ in damping and length; those of all origins are
/// simulated in parallel. For rigid drives the initial states also move by different shares of the linearised
/// step.
std::vector<Trial> bestSteps(const FitData& data, const std::vector<StepOrigin>& origins);

}  // namespace capstan::diagnosis
