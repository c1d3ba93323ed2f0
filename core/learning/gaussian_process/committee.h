#pragma once

#include <vector>

#include "core/learning/gaussian_process/sparse_process.h"

namespace capstan::learning {

/// Sparse processes of the same outputs, each of its own hyperparameters and inducing points, that are
/// averaged: what a likelihood of some hundred points leaves open, and where inducing points happen to lie,
/// is chance, and goes down with the members' number (bagging: Breiman, Machine Learning 24 (1996); of
/// Gaussian processes Chen and Ren, Neurocomputing 72 (2009)).
///     mean = mean_k of μ_k,   variance = mean_k of σ_k² + mean_k of (μ_k − mean)²
/// that of an equal mixture, the spread being the mean of all outputs'. Members know the same points.
class Committee {
 public:
  /// One member at least; all of as many outputs.
  explicit Committee(std::vector<SparseProcess> members);

  /// Points x (n × d) with outputs y (n × q) and noise besides (n), as SparseProcess::add.
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& besides);

  Prediction predict(const Eigen::MatrixXd& at) const;
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;
  /// Of one output at all pairs of points; its diagonal is predict()'s variance.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& at) const;

  double signalVariance() const;  ///< without data, the members' mean
  double noiseVariance() const;   ///< likewise
  Eigen::Index outputs() const { return members_.front().outputs(); }
  const std::vector<SparseProcess>& members() const { return members_; }

 private:
  std::vector<SparseProcess> members_;
};

}  // namespace capstan::learning
