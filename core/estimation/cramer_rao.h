#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/base/check.h"
#include "core/estimation/models.h"

namespace capstan::estimation {

/// Posterior Cramér–Rao bound of a discrete-time nonlinear filter: no estimator has a smaller mean square
/// error than J⁻¹ (Tichavský, Muravchik and Nehorai, IEEE Trans. Signal Processing 46 (1998)). For
///     x' = f(x) + w, w ~ N(0, Q),    y = h(x) + v, v ~ N(0, R),
/// the paper's recursion (21), with (34)–(36) for additive Gaussian noise and the Jacobians F, H of f, h, is
///     J' = Q⁻¹ − Q⁻¹ E[F] (J + E[Fᵀ Q⁻¹ F])⁻¹ E[F]ᵀ Q⁻¹ + E[Hᵀ R⁻¹ H]
/// with expectations over the true states. If all is linear and Gaussian, J⁻¹ is the Kalman covariance.
template <int N>
class PosteriorInformation {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;

  /// `initial` is J of the prior: the inverse of its covariance when the prior is Gaussian.
  explicit PosteriorInformation(const Matrix& initial) : information_(initial) {}

  /// Predicts one step of the model with E[F], E[Fᵀ Q⁻¹ F] and Q⁻¹; Q must not be singular.
  void predict(const Matrix& transition, const Matrix& weighted, const Matrix& inverse_q) {
    const Matrix gain = inverse_q * transition;
    const Matrix next = inverse_q - gain * (information_ + weighted).llt().solve(gain.transpose());
    information_ = 0.5 * (next + next.transpose());
  }
  /// Adds the information E[Hᵀ R⁻¹ H] of a measurement.
  void update(const Matrix& gained) { information_ += gained; }

  const Matrix& information() const { return information_; }  ///< J
  Matrix bound() const { return information_.llt().solve(Matrix::Identity()); }

 private:
  Matrix information_;
};

/// Computes the expectations of PosteriorInformation per step as averages over Monte-Carlo runs of equal
/// length. Each run adds one transition per step, and a measurement in the steps that have one. Memory: 3 N²
/// doubles per step. For long runs use one average per segment of time and continue bounds() from the
/// previous segment.
template <int N>
class CramerRaoAverage {
 public:
  using Matrix = Eigen::Matrix<double, N, N>;

  CramerRaoAverage(std::size_t steps, const Matrix& inverse_q) : inverse_q_(inverse_q), sums_(steps) {}

  /// Adds F of step k of one run, at the true state of that run.
  void addTransition(std::size_t k, const Matrix& f) {
    sums_[k].transition += f;
    sums_[k].weighted.noalias() += f.transpose() * inverse_q_ * f;
  }
  /// Adds Hᵀ R⁻¹ H of one run, at its true state at the end of step k.
  void addMeasurement(std::size_t k, const Matrix& gained) { sums_[k].gained += gained; }
  void endRun() { ++runs_; }

  /// Adds the runs of another average. The order of merging affects the last bits of the result.
  void merge(const CramerRaoAverage& other) {
    CAPSTAN_CHECK(other.sums_.size() == sums_.size());
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      sums_[k].transition += other.sums_[k].transition;
      sums_[k].weighted += other.sums_[k].weighted;
      sums_[k].gained += other.sums_[k].gained;
    }
    runs_ += other.runs_;
  }

  /// Diagonal of the bound at the end of each step; `initial` is J of the prior. Needs at least one run.
  std::vector<Eigen::Matrix<double, N, 1>> bounds(const Matrix& initial) const {
    PosteriorInformation<N> posterior(initial);
    return bounds(posterior);
  }
  /// Diagonal of the bound at the end of each step, from `posterior` on; sets `posterior` to the last step's.
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

/// Jacobian F = df/dx of one step by central differences of half-width width(j), in one call of propagate().
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
