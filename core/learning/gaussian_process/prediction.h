#pragma once

#include <Eigen/Core>

namespace capstan::learning {

/// Prediction of a process at some points, one row per point.
struct Prediction {
  Eigen::MatrixXd mean;      ///< one column per output
  Eigen::VectorXd variance;  ///< variance of the function without noise, equal for all outputs
};

}  // namespace capstan::learning
