#pragma once

#include <optional>

#include "core/learning/gaussian_process/kernel.h"

namespace capstan::learning {

/// −ln p(Y | X, θ) of outputs Y (n × q, mean 0) that share one kernel (Rasmussen and Williams, (2.30)):
///     Σ_j ½ y_jᵀ K⁻¹ y_j + q (½ ln |K| + ½ n ln 2π),   K = K_f + σ_n² I
/// and its derivatives by KernelParameters::packed() (5.9):
///     ½ tr(W ∂K/∂θ),   W = q K⁻¹ − A Aᵀ, A = K⁻¹ Y.
/// One Cholesky and one inverse, O(n³); the length-scales cost n² d more. A search asks for many θ: memory of
/// n × n is used again from one to the next.
class MarginalLikelihood {
 public:
  /// Points x (n × d) and outputs y outlive it.
  MarginalLikelihood(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y);
  MarginalLikelihood(Eigen::MatrixXd&&, const Eigen::MatrixXd&) = delete;
  MarginalLikelihood(const Eigen::MatrixXd&, Eigen::MatrixXd&&) = delete;
  MarginalLikelihood(Eigen::MatrixXd&&, Eigen::MatrixXd&&) = delete;

  /// With derivatives where `gradient` is given. Nothing: K is not positive definite.
  std::optional<double> negativeLog(const KernelParameters& parameters, Eigen::VectorXd* gradient);

 private:
  const Eigen::MatrixXd& x_;
  const Eigen::MatrixXd& y_;
  Eigen::MatrixXd signal_, covariance_;  ///< K_f; K, its factor, W: lower triangles
};

}  // namespace capstan::learning
