#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace capstan::estimation {

/// Information of observations about N coefficients x, in units of their prior standard deviations `sigma`:
///
///     z_k = H_k diag(sigma) x + v_k,  v_k ~ N(0, R_k):   Λ = Σ Hᵀ R⁻¹ H,   h = Σ Hᵀ R⁻¹ z,
///
/// The likelihood is exp(−½ xᵀ Λ x + hᵀ x) up to a constant factor. No allocation.
template <int N>
struct Information {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  Matrix matrix = Matrix::Zero();  ///< Λ
  Vector score = Vector::Zero();   ///< h
  int count = 0;                   ///< number of observations

  /// Adds one observation z of M outputs with noise covariance `r`. Returns false and changes nothing when a
  /// number is not finite or `r` is not positive definite.
  template <int M>
  bool add(const Eigen::Matrix<double, M, N>& h, const Eigen::Matrix<double, M, 1>& z,
           const Eigen::Matrix<double, M, M>& r, const Vector& sigma) {
    const Eigen::LLT<Eigen::Matrix<double, M, M>> root(r);
    if (root.info() != Eigen::Success || !h.allFinite() || !z.allFinite()) return false;
    const Eigen::Matrix<double, M, N> whitened = root.matrixL().solve(h * sigma.asDiagonal());
    const Eigen::Matrix<double, M, 1> y = root.matrixL().solve(z);
    if (!whitened.allFinite() || !y.allFinite()) return false;
    matrix.noalias() += whitened.transpose() * whitened;
    score.noalias() += whitened.transpose() * y;
    ++count;
    return true;
  }

  Information& operator+=(const Information& other) {
    matrix += other.matrix;
    score += other.score;
    count += other.count;
    return *this;
  }

  /// Multiplies the weight of all observations by `factor`.
  void scale(double factor) {
    matrix *= factor;
    score *= factor;
  }

  /// Information about x + w, w ~ N(0, diag(variance)), for coefficients that may have changed by w since.
  Information released(const Vector& variance) const {
    const Vector sigma = variance.cwiseSqrt();
    const Matrix left = matrix * sigma.asDiagonal();
    Matrix inner = sigma.asDiagonal() * left;
    inner.diagonal().array() += 1.0;
    const Eigen::LLT<Matrix> root(inner);
    Information released = *this;
    released.matrix.noalias() -= left * root.solve(left.transpose());
    released.score.noalias() -= left * root.solve(sigma.cwiseProduct(score));
    released.matrix = 0.5 * (released.matrix + released.matrix.transpose()).eval();
    return released;
  }

  /// Log evidence under the prior N(0, diag(1 / precision)), up to a constant that depends on the data only.
  /// `weight` is the weight of the observations.
  double logEvidence(const Vector& precision, double weight = 1.0) const {
    Matrix posterior = weight * matrix;
    posterior.diagonal() += precision;
    const Eigen::LLT<Matrix> root(posterior);
    const Vector whitened = root.matrixL().solve(weight * score);
    return 0.5 * whitened.squaredNorm() - root.matrixLLT().diagonal().array().log().sum() +
           0.5 * precision.array().log().sum();
  }
};

}  // namespace capstan::estimation
