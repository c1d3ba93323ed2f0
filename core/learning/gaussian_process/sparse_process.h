#pragma once

#include <cstdint>
#include <vector>

#include "core/learning/gaussian_process/kernel.h"
#include "core/learning/gaussian_process/prediction.h"

namespace capstan::learning {

/// Draws `count` of `points` row indices without replacement, in increasing order; all rows if there are not
/// more.
std::vector<Eigen::Index> drawnPoints(Eigen::Index points, Eigen::Index count, std::uint64_t seed);

/// State of a sparse process, as stored in a file.
struct SparseProcessParts {
  KernelParameters parameters;
  Eigen::MatrixXd inducing;  ///< in length-scales, m × d
  Eigen::MatrixXd square;    ///< B, m × m, lower triangle
  Eigen::MatrixXd sum;       ///< V Λ⁻¹ Y, m × q
};

/// Gaussian process regression through inducing points u (Titsias, Variational learning of inducing variables
/// in sparse Gaussian processes, AISTATS 2009; the mean equals that of the deterministic training
/// conditional, Quiñonero-Candela and Rasmussen, JMLR 6 (2005)):
///     mean(x) = k_xu L⁻ᵀ B⁻¹ V Λ⁻¹ Y,   K_uu = L Lᵀ, V = L⁻¹ K_uf, B = I + V Λ⁻¹ Vᵀ
///     variance(x) = σ_f² − |L⁻¹ k_ux|² + |L_B⁻¹ L⁻¹ k_ux|²,   B = L_B L_Bᵀ
/// Λ is the diagonal noise covariance of the points: σ_n² plus additional noise per point. Construction costs
/// O(n m²), a mean O(m), a variance O(m²). If all points are inducing points, it is the exact process. Adding
/// a point later costs O(m²), plus one factorization of B, O(m³), per call.
class SparseProcess {
 public:
  /// Creates a process without training points, with inducing points (m × d) and q outputs of mean 0.
  SparseProcess(const Eigen::MatrixXd& inducing, Eigen::Index outputs, KernelParameters parameters);

  explicit SparseProcess(SparseProcessParts parts);

  /// Adds training points x (n × d) with outputs y (n × q); their noise variance is σ_n² + `besides` (n, not
  /// negative).
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& besides);
  /// Adds training points with the noise variance σ_n².
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y);

  Prediction predict(const Eigen::MatrixXd& at) const;
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;
  /// Covariance of one output at all pairs of points; its diagonal is the variance of predict().
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& at) const;

  const KernelParameters& parameters() const { return known_.parameters; }
  Eigen::Index inducing() const { return known_.inducing.rows(); }
  Eigen::Index outputs() const { return known_.sum.cols(); }
  const SparseProcessParts& parts() const { return known_; }

 private:
  void findRoot();
  void factorise();

  SparseProcessParts known_;
  Eigen::MatrixXd root_;     ///< L
  Eigen::MatrixXd factor_;   ///< L_B
  Eigen::MatrixXd weights_;  ///< L⁻ᵀ B⁻¹ V Λ⁻¹ Y
};

}  // namespace capstan::learning
