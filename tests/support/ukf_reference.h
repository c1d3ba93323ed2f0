#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <functional>

#include "core/estimation/sigma_rule.h"

namespace capstan::test {

/// Unscented Kalman filter as in textbooks, in any precision T: full covariance, a new Cholesky factor for
/// each set of sigma points, P ← P − K P_yy Kᵀ. In long double it is the reference for the square-root form.
template <class T, int N>
class UkfReference {
 public:
  using State = Eigen::Matrix<T, N, 1>;
  using Matrix = Eigen::Matrix<T, N, N>;

  UkfReference() {
    using Rule = estimation::SigmaRule;
    const T alpha = T(Rule::kAlpha);
    const T lambda = alpha * alpha * (T(N) + T(Rule::kKappa)) - T(N);
    spread_ = std::sqrt(T(N) + lambda);
    centre_mean_ = lambda / (T(N) + lambda);
    centre_covariance_ = centre_mean_ + T(1) - alpha * alpha + T(Rule::kBeta);
    other_ = T(1) / (T(2) * (T(N) + lambda));
  }

  void reset(const State& mean, const Matrix& covariance) {
    mean_ = mean;
    covariance_ = covariance;
  }

  void predict(const std::function<State(const State&)>& f, const Matrix& q) {
    Eigen::Matrix<T, N, kPoints> x = points();
    for (int c = 0; c < kPoints; ++c) x.col(c) = f(x.col(c));
    mean_ = meanOf(x);
    covariance_ = q;
    for (int c = 0; c < kPoints; ++c)
      covariance_ += weight(c) * (x.col(c) - mean_) * (x.col(c) - mean_).transpose();
  }

  template <int M>
  void update(const std::function<Eigen::Matrix<T, M, 1>(const State&)>& h, const Eigen::Matrix<T, M, 1>& y,
              const Eigen::Matrix<T, M, M>& r) {
    const Eigen::Matrix<T, N, kPoints> x = points();
    Eigen::Matrix<T, M, kPoints> z;
    for (int c = 0; c < kPoints; ++c) z.col(c) = h(x.col(c));
    const Eigen::Matrix<T, M, 1> expected = meanOf(z);
    Eigen::Matrix<T, M, M> yy = r;
    Eigen::Matrix<T, N, M> xy = Eigen::Matrix<T, N, M>::Zero();
    for (int c = 0; c < kPoints; ++c) {
      yy += weight(c) * (z.col(c) - expected) * (z.col(c) - expected).transpose();
      xy += weight(c) * (x.col(c) - mean_) * (z.col(c) - expected).transpose();
    }
    const Eigen::Matrix<T, N, M> gain = xy * yy.inverse();
    mean_ += gain * (y - expected);
    covariance_ -= gain * yy * gain.transpose();
  }

  const State& mean() const { return mean_; }
  const Matrix& covariance() const { return covariance_; }

 private:
  static constexpr int kPoints = 2 * N + 1;
  T weight(int c) const { return c == 0 ? centre_covariance_ : other_; }
  Eigen::Matrix<T, N, kPoints> points() const {
    const Matrix root = covariance_.llt().matrixL();
    Eigen::Matrix<T, N, kPoints> x;
    x.colwise() = mean_;
    for (int j = 0; j < N; ++j) {
      x.col(1 + j) += spread_ * root.col(j);
      x.col(1 + N + j) -= spread_ * root.col(j);
    }
    return x;
  }
  template <class Points>
  Eigen::Matrix<T, Points::RowsAtCompileTime, 1> meanOf(const Points& x) const {
    return centre_mean_ * x.col(0) + other_ * x.template rightCols<2 * N>().rowwise().sum();
  }

  T spread_, centre_mean_, centre_covariance_, other_;
  State mean_ = State::Zero();
  Matrix covariance_ = Matrix::Identity();
};

}  // namespace capstan::test
