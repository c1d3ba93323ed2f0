#pragma once

#include "core/learning/gaussian_process/kernel.h"
#include "core/learning/gaussian_process/prediction.h"

namespace capstan::learning {

/// Gaussian process regression by the Cholesky factor of all points (Rasmussen and Williams, algorithm 2.1).
/// Construction is O(n³), which is feasible for thousands of points.
class ExactProcess {
 public:
  /// Points x (n × d), and outputs y (n × q) of mean 0 with one common kernel. With repeated points and very
  /// little noise, K is numerically singular; its diagonal is then increased by the smallest power of ten,
  /// from 1e-12 of the signal's variance, that makes it positive definite. jitter() returns this amount.
  ExactProcess(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, KernelParameters parameters);

  Prediction predict(const Eigen::MatrixXd& at) const;
  /// Predicted means without variances, O(n) per point.
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;

  const KernelParameters& parameters() const { return parameters_; }
  double jitter() const { return jitter_; }  ///< [variance of the signal]

 private:
  KernelParameters parameters_;
  Eigen::MatrixXd z_;        ///< points in units of the length scales
  Eigen::MatrixXd root_;     ///< L, K = L Lᵀ
  Eigen::MatrixXd weights_;  ///< K⁻¹ Y
  double jitter_ = 0.0;
};

}  // namespace capstan::learning
