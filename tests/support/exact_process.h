#pragma once

#include "core/learning/gaussian_process/kernel.h"
#include "core/learning/gaussian_process/prediction.h"

namespace capstan::learning {

/// Gaussian process regression by the Cholesky factor of all points (Rasmussen and Williams, algorithm 2.1);
/// O(n³) to make, for thousands of points.
class ExactProcess {
 public:
  /// Points x (n × d), outputs y (n × q) of mean 0, with equal kernel. Where points repeat and the noise is
  /// next to none, K is singular to rounding: as much is added to its diagonal, in powers of ten from 1e-12
  /// of the signal's variance, as it takes, and told as jitter().
  ExactProcess(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, KernelParameters parameters);

  Prediction predict(const Eigen::MatrixXd& at) const;
  /// Means alone, O(n) each.
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;

  const KernelParameters& parameters() const { return parameters_; }
  double jitter() const { return jitter_; }  ///< [variance of the signal]

 private:
  KernelParameters parameters_;
  Eigen::MatrixXd z_;        ///< points in lengths
  Eigen::MatrixXd root_;     ///< L, K = L Lᵀ
  Eigen::MatrixXd weights_;  ///< K⁻¹ Y
  double jitter_ = 0.0;
};

}  // namespace capstan::learning
