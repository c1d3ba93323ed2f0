#pragma once

#include <cstdint>
#include <vector>

#include "core/learning/gaussian_process/kernel.h"
#include "core/learning/gaussian_process/prediction.h"

namespace capstan::learning {

/// `count` of `points` rows, drawn without replacement, in rising order; all where there are no more.
std::vector<Eigen::Index> drawnPoints(Eigen::Index points, Eigen::Index count, std::uint64_t seed);

/// What a sparse process knows, as a file keeps it.
struct SparseProcessParts {
  KernelParameters parameters;
  Eigen::MatrixXd inducing;  ///< in lengths, m × d
  Eigen::MatrixXd square;    ///< B, m × m, lower triangle
  Eigen::MatrixXd sum;       ///< V Λ⁻¹ Y, m × q
};

/// Gaussian process regression through inducing points u (Titsias, Variational learning of inducing variables
/// in sparse Gaussian processes, AISTATS 2009; its mean is the deterministic training conditional's,
/// Quiñonero-Candela and Rasmussen, JMLR 6 (2005)):
///     mean(x) = k_xu L⁻ᵀ B⁻¹ V Λ⁻¹ Y,   K_uu = L Lᵀ, V = L⁻¹ K_uf, B = I + V Λ⁻¹ Vᵀ
///     variance(x) = σ_f² − |L⁻¹ k_ux|² + |L_B⁻¹ L⁻¹ k_ux|²,   B = L_B L_Bᵀ
/// Λ the points' noise, σ_n² and what each has besides; O(n m²) to make, O(m) for a mean, O(m²) for a
/// variance; with all points as inducing ones it is the exact process. Points can be added later at O(m²)
/// each and one factor of B, O(m³).
class SparseProcess {
 public:
  /// Inducing points (m × d) and outputs (of which there are q) of mean 0; knows no points yet.
  SparseProcess(const Eigen::MatrixXd& inducing, Eigen::Index outputs, KernelParameters parameters);

  explicit SparseProcess(SparseProcessParts parts);

  /// Learns points x (n × d) with outputs y (n × q), whose noise has the variance σ_n² + `besides` (n, none
  /// negative).
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& besides);
  /// Likewise, of nothing besides.
  void add(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y);

  Prediction predict(const Eigen::MatrixXd& at) const;
  Eigen::MatrixXd mean(const Eigen::MatrixXd& at) const;
  /// Of one output at all pairs of points; its diagonal is predict()'s variance.
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
