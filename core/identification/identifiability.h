#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/identification/output_error.h"

namespace capstan::identification {

/// What a recording can say about one parameter, before anything is fitted.
struct Visibility {
  double sigma_alone = 0.0;  ///< of the logarithm, everything else known
  double sigma = 0.0;        ///< of the logarithm, everything else unknown up to its prior
  double moved = 0.0;        ///< RMS change of its joint for a change of one prior sigma [rad or m]
  double noise = 0.0;        ///< RMS camera noise of that joint [rad or m]
  int partner = -1;          ///< unknown it is most correlated with (behind the set: CameraPose)
  double correlation = 0.0;  ///< with it
  double stated = 0.0;       ///< sigma of the estimate with all that it counts; `sigma` before there is one
  bool seen = false;         ///< stated is below kSeenShare of the prior's
  std::string advice;        ///< why not, and what to do; empty when seen
};

/// Local identifiability at x: singular values of the Jacobian scaled by noise and priors (a value below one:
/// the prior constrains that direction more than the recording does), and what follows for each parameter.
struct Identifiability {
  Eigen::VectorXd singular_values;     ///< falling
  Eigen::MatrixXd directions;          ///< right singular vectors, column by column, over the unknowns
  std::vector<Visibility> parameters;  ///< in the set's order
  int observations = 0;
};

/// `jacobian` of `problem` at its last evaluate().
Identifiability assess(const OutputError& problem, const ParameterSet& set, const Eigen::MatrixXd& jacobian);

/// Sets the unknown, of the `count` first, that i is most correlated with, whatever it held before.
void findPartner(const Eigen::MatrixXd& covariance, int i, int count, Visibility& visibility);

/// Unknown i of OutputError in words: "joint 1's damping", "the camera's turn about y".
std::string wordsOf(const ParameterSet& set, int unknown);

/// Why parameter i is not seen, or seen but not known to its goal, and what would help: it moves the output
/// by less than noise, or noise alone would leave it bound up with another unknown (|correlation| beyond
/// 0.7), or what the model does not know of friction and hysteresis hides it.
std::string adviceFor(const ParameterSet& set, int i, const Visibility& visibility, int observations);

}  // namespace capstan::identification
