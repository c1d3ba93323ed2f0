#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Linearisation of a fit in its free parameters: those that no bound holds.
struct FreeSystem {
  std::vector<Eigen::Index> free;               ///< indices of the free parameters
  Eigen::MatrixXd jacobian;                     ///< weighted, readings × free
  Eigen::VectorXd e;                            ///< weighted residual
  Eigen::MatrixXd normal;                       ///< Jᵀ J + priors
  std::vector<std::vector<Eigen::Index>> rows;  ///< readings of each block

  /// `hold_events`: times of single events are not free.
  FreeSystem(const FitData& data, const Fit& fit, const Weighting& weighting, bool hold_events);
};

}  // namespace capstan::diagnosis
