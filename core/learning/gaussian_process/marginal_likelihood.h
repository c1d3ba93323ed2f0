#pragma once

#include <optional>

#include "core/learning/gaussian_process/kernel.h"

namespace capstan::learning {

/// Negative log marginal likelihood −ln p(Y | X, θ) of outputs Y (n × q, mean 0) that share one kernel
/// (Rasmussen and Williams, (2.30)):
///     Σ_j ½ y_jᵀ K⁻¹ y_j + q (½ ln |K| + ½ n ln 2π),   K = K_f + σ_n² I
/// and its derivatives with respect to KernelParameters::packed() (5.9):
///     ½ tr(W ∂K/∂θ),   W = q K⁻¹ − A Aᵀ, A = K⁻¹ Y.
/// One evaluation needs one Cholesky factorization and one inverse, O(n³), and n² d more for the
/// length-scales. The n × n memory is reused, because a search evaluates many θ.
class MarginalLikelihood {
 public:
  /// Points x (n × d) and outputs y must outlive this object.
  MarginalLikelihood(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y);
  MarginalLikelihood(Eigen::MatrixXd&&, const Eigen::MatrixXd&) = delete;
  MarginalLikelihood(const Eigen::MatrixXd&, Eigen::MatrixXd&&) = delete;
  MarginalLikelihood(Eigen::MatrixXd&&, Eigen::MatrixXd&&) = delete;

  /// Negative log likelihood, with derivatives if `gradient` is given. Nothing: K is not positive definite.
  std::optional<double> negativeLog(const KernelParameters& parameters, Eigen::VectorXd* gradient);

 private:
  const Eigen::MatrixXd& x_;
  const Eigen::MatrixXd& y_;
  Eigen::MatrixXd signal_, covariance_;  ///< K_f; K, then its factor, then W: lower triangles
};

}  // namespace capstan::learning
