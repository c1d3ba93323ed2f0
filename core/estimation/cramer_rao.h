#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/base/check.h"
#include "core/estimation/models.h"

namespace capstan::estimation {

/// Posterior Cramér–Rao bound of a discrete-time nonlinear filter: no estimator whatever has a smaller mean
/// square error than J⁻¹ (Tichavský, Muravchik and Nehorai, IEEE Trans. Signal Processing 46 (1998)). For
///     x' = f(x) + w, w ~ N(0, Q),    y = h(x) + v, v ~ N(0, R),
/// its recursion (21), with (34)–(36) for additive Gaussian noise and F, H the Jacobians of f, h, is
///     J' = Q⁻¹ − Q⁻¹ E[F] (J + E[Fᵀ Q⁻¹ F])⁻¹ E[F]ᵀ Q⁻¹ + E[Hᵀ R⁻¹ H]
/// with expectations over the true states. Linear and Gaussian: J⁻¹ is the Kalman filter's covariance.
template <int N>
class PosteriorInformation {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;

  /// `initial` is J of the prior: the inverse of its covariance for a Gaussian one.
  explicit PosteriorInformation(const Matrix& initial) : information_(initial) {}

  /// A step of the model: E[F], E[Fᵀ Q⁻¹ F] and Q⁻¹, Q not singular.
  void predict(const Matrix& transition, const Matrix& weighted, const Matrix& inverse_q) {
    const Matrix gain = inverse_q * transition;
    const Matrix next = inverse_q - gain * (information_ + weighted).llt().solve(gain.transpose());
    information_ = 0.5 * (next + next.transpose());
  }
  /// A measurement: E[Hᵀ R⁻¹ H].
  void update(const Matrix& gained) { information_ += gained; }

  const Matrix& information() const { return information_; }  ///< J
  Matrix bound() const { return information_.llt().solve(Matrix::Identity()); }

 private:
  Matrix information_;
};

/// Gathers the expectations of PosteriorInformation from Monte-Carlo runs of equal length, step by step. Each
/// run gives every step its transition; a measurement where there is one. Memory: 3 N² doubles a step; for
/// long runs one average after the other, each of a segment of time, and bounds() going on from the last.
template <int N>
class CramerRaoAverage {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;

  CramerRaoAverage(std::size_t steps, const Matrix& inverse_q) : inverse_q_(inverse_q), sums_(steps) {}

  /// F of one run's step k, at its true state there.
  void addTransition(std::size_t k, const Matrix& f) {
    sums_[k].transition += f;
    sums_[k].weighted.noalias() += f.transpose() * inverse_q_ * f;
  }
  /// Hᵀ R⁻¹ H of one run, at its true state at the end of step k.
  void addMeasurement(std::size_t k, const Matrix& gained) { sums_[k].gained += gained; }
  void endRun() { ++runs_; }

  /// The runs of another average as well. The order of merging decides the last bits.
  void merge(const CramerRaoAverage& other) {
    CAPSTAN_CHECK(other.sums_.size() == sums_.size());
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      sums_[k].transition += other.sums_[k].transition;
      sums_[k].weighted += other.sums_[k].weighted;
      sums_[k].gained += other.sums_[k].gained;
    }
    runs_ += other.runs_;
  }

  /// Diagonal of the bound at the end of each step, from the prior's information on. At least one run.
  std::vector<Eigen::Matrix<double, N, 1>> bounds(const Matrix& initial) const {
    PosteriorInformation<N> posterior(initial);
    return bounds(posterior);
  }
  /// The same from `posterior` on, which is then that at the end of the last step.
  std::vector<Eigen::Matrix<double, N, 1>> bounds(PosteriorInformation<N>& posterior) const {
    CAPSTAN_CHECK(runs_ > 0);
    std::vector<Eigen::Matrix<double, N, 1>> all;
    all.reserve(sums_.size());
    const double share = 1.0 / static_cast<double>(runs_);
    for (const Sums& at : sums_) {
      posterior.predict(share * at.transition, share * at.weighted, inverse_q_);
      posterior.update(share * at.gained);
      all.push_back(posterior.bound().diagonal());
    }
    return all;
  }

 private:
  struct Sums {
    Matrix transition = Matrix::Zero(), weighted = Matrix::Zero(), gained = Matrix::Zero();
  };
  Matrix inverse_q_;
  std::vector<Sums> sums_;
  std::size_t runs_ = 0;
};

/// F = df/dx of a step by central differences of `width` along each state, all points at once.
template <StateModel Model>
Eigen::Matrix<double, Model::kStates, Model::kStates> transitionJacobian(
    const Model& model, const Eigen::Matrix<double, Model::kStates, 1>& x, const typename Model::Input& input,
    double dt, const Eigen::Matrix<double, Model::kStates, 1>& width) {
  constexpr int N = Model::kStates;
  alignas(64) SigmaPoints<N> points;
  points.colwise() = x;
  for (int j = 0; j < N; ++j) {
    points(j, 1 + j) += width(j);
    points(j, 1 + N + j) -= width(j);
  }
  model.propagate(points, input, dt);
  Eigen::Matrix<double, N, N> f;
  for (int j = 0; j < N; ++j) f.col(j) = (points.col(1 + j) - points.col(1 + N + j)) / (2.0 * width(j));
  return f;
}

}  // namespace capstan::estimation
