#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/identification/estimate.h"
#include "core/identification/output_error.h"

namespace capstan::identification {

/// Observability of one parameter in a recording.
struct Visibility {
  double sigma_alone = 0.0;  ///< σ of the logarithm if all other unknowns were known
  double sigma = 0.0;        ///< σ of the logarithm with all other unknowns unknown up to their priors
  double moved = 0.0;        ///< RMS change of its joint for a change of one prior sigma [rad or m]
  double noise = 0.0;        ///< RMS camera noise of that joint [rad or m]
  int partner = -1;          ///< unknown with the largest correlation (after the set: CameraPose); -1: none
  double correlation = 0.0;  ///< correlation with `partner`
  double stated = 0.0;       ///< σ that the estimate states; `sigma` before there is an estimate
  bool seen = false;         ///< observable: `stated` is below kSeenShare of the prior's σ
  std::string advice;        ///< reason and remedy; empty if observable
};

/// Local identifiability at x: singular values of the Jacobian scaled by noise and priors, and the
/// observability of each parameter. A singular value below one: the prior constrains that direction more than
/// the recording does.
struct Identifiability {
  Eigen::VectorXd singular_values;     ///< in decreasing order
  Eigen::MatrixXd directions;          ///< right singular vectors over the unknowns, one per column
  std::vector<Visibility> parameters;  ///< in the set's order
  int observations = 0;
};

/// Identifiability of `problem` from its `jacobian` at the last evaluate().
Identifiability assess(const OutputError& problem, const ParameterSet& set, const Eigen::MatrixXd& jacobian);

/// Sets partner and correlation: the unknown among the first `count` that correlates most with unknown i.
void findPartner(const Eigen::MatrixXd& covariance, int i, int count, Visibility& visibility);

/// Unknown i of OutputError in words: "joint 1's damping", "the camera's rotation about y".
std::string wordsOf(const ParameterSet& set, int unknown);

/// Reason why a parameter i is not observable, or not known to its goal. kCorrelated: |correlation| above
/// 0.7.
Weakness weaknessOf(const ParameterSet& set, int i, const Visibility& visibility, int observations);
/// Advice for such a parameter: the reason in numbers, and a remedy.
std::string adviceFor(const ParameterSet& set, int i, const Visibility& visibility, int observations);

}  // namespace capstan::identification
