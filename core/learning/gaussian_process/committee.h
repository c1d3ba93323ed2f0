#pragma once

#include <vector>

#include "core/learning/gaussian_process/sparse_process.h"

namespace capstan::learning {

/// Average of sparse processes of the same outputs, each with its own hyperparameters and inducing points.
/// Hyperparameters from a few hundred points and the choice of inducing points have a random error, which
/// averaging reduces (bagging: Breiman, Machine Learning 24 (1996); for Gaussian processes Chen and Ren,
/// Neurocomputing 72 (2009)).
///     mean = mean_k of μ_k,   variance = mean_k of σ_k² + mean_k of (μ_k − mean)²
/// This is the variance of an equal mixture; the second term is averaged over the outputs. All members have
/// the same training points.
class Committee {
 public:
  /// Creates a committee of at least one member; all must have the same number of outputs.
  explicit Committee(std::vector<SparseProcess> members);

  /// Adds points x (n × d) with outputs y (n × q) and additional noise variances `besides` (n), as
  /// SparseProcess::add.
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& besides);

  Prediction predict(const Eigen::MatrixXd& at) const;
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;
  /// Covariance of one output at all pairs of points; its diagonal is the variance of predict().
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& at) const;

  double signalVariance() const;  ///< variance without data, mean of the members
  double noiseVariance() const;   ///< noise variance, mean of the members
  Eigen::Index outputs() const { return members_.front().outputs(); }
  const std::vector<SparseProcess>& members() const { return members_; }

 private:
  std::vector<SparseProcess> members_;
};

}  // namespace capstan::learning
