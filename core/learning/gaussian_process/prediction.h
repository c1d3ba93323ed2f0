#pragma once

#include <Eigen/Core>

namespace capstan::learning {

/// What a process says at some points, a row each.
struct Prediction {
  Eigen::MatrixXd mean;      ///< a column an output
  Eigen::VectorXd variance;  ///< of the function, without the noise; the same of all outputs
};

}  // namespace capstan::learning
