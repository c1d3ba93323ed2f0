#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "core/base/check.h"
#include "core/estimation/models.h"
#include "core/estimation/sigma_rule.h"
#include "core/math/cholesky.h"
#include "core/math/triangularise.h"

namespace capstan::estimation {

template <int N>
using Lower = Eigen::Matrix<double, N, N, Eigen::RowMajor>;

/// Result of an update with one measurement of M outputs.
template <int M>
struct UpdateReport {
  Eigen::Matrix<double, M, 1> innovation = Eigen::Matrix<double, M, 1>::Zero();  ///< y − predicted y
  Lower<M> root = Lower<M>::Zero();  ///< lower triangular square root of the innovation's covariance
  double nis = 0.0;                  ///< normalised innovation squared: chi-square with M degrees of freedom
  bool applied = false;  ///< false when an input or result is not finite; the state is then unchanged
  bool rescued = false;  ///< whether a down-date lost definiteness and the fallback was used
};

/// Square-root unscented Kalman filter with additive noise (van der Merwe and Wan, ICASSP 2001; van der Merwe
/// 2004, section 3.3), the UKF paper's srUKF. It stores the mean and a lower triangular S, and never the
/// covariance S Sᵀ.
///
/// Prediction: S ← tria [√Wc (X − x̄), √Q]. All weights are positive (SigmaRule), so there is no down-date.
/// Update with any h: sigma points are redrawn; S_y = tria [√Wc (Y − ŷ), √R]; U = P_xy S_y⁻ᵀ; x̂ += U S_y⁻¹ν;
/// S is down-dated by the columns of U. When a down-date loses definiteness, the same covariance is formed as
/// a sum of squares, S = tria [√Wc (X − x̂ − K (Y − ŷ)), K √R], which cannot fail. This fallback is counted as
/// a rescue. Update with y = H x: one orthogonal triangularisation, tria [√R, H S; 0, S] = [S_y, 0; U, S⁺].
/// It is exact and needs no fallback.
///
/// The state stays finite: a prediction that is not finite keeps the mean and adds Q, and a measurement that
/// is not finite is refused. Both are counted as rescues. No allocation. Copyable; over-aligned (64 bytes).
template <int N>
class SquareRootUkf {
 public:
  using State = Eigen::Matrix<double, N, 1>;
  using Points = SigmaPoints<N>;

  SquareRootUkf() { stack_.setZero(); }

  /// Sets the mean and the covariance root rootᵀ. `root` is lower triangular; all numbers must be finite.
  void reset(const State& mean, const Lower<N>& root);

  /// Predicts to t + dt. `sqrt_q` is any square root of the process noise of the step. False when rescued.
  template <StateModel Model>
  bool predict(const Model& model, const typename Model::Input& input, double dt, const Lower<N>& sqrt_q);

  /// Updates with y = h(x) + noise of covariance sqrt_r sqrt_rᵀ. sqrt_r is lower triangular, and the
  /// covariance of the innovation must not be singular.
  template <MeasurementModel<N> Measurement>
  UpdateReport<Measurement::kOutputs> update(const Measurement& measurement,
                                             const Eigen::Matrix<double, Measurement::kOutputs, 1>& y,
                                             const Lower<Measurement::kOutputs>& sqrt_r);
  template <int M>
  UpdateReport<M> update(const LinearMeasurement<N, M>& measurement, const Eigen::Matrix<double, M, 1>& y,
                         const Lower<M>& sqrt_r) {
    return linearUpdate(measurement, y, sqrt_r, true);
  }
  /// Returns the report that update() would return, without a change of the state.
  template <int M>
  UpdateReport<M> peek(const LinearMeasurement<N, M>& measurement, const Eigen::Matrix<double, M, 1>& y,
                       const Lower<M>& sqrt_r) {
    return linearUpdate(measurement, y, sqrt_r, false);
  }

  const State& mean() const { return mean_; }
  const Lower<N>& squareRoot() const { return root_; }
  Eigen::Matrix<double, N, N> covariance() const { return root_ * root_.transpose(); }
  /// Number of rescues since construction.
  std::uint64_t rescues() const { return rescues_; }

 private:
  void drawPoints();
  void spreadAgain(const Lower<N>& sqrt_q);
  template <int M>
  UpdateReport<M> linearUpdate(const LinearMeasurement<N, M>& measurement,
                               const Eigen::Matrix<double, M, 1>& y, const Lower<M>& sqrt_r, bool apply);

  alignas(64) Points points_;
  alignas(64) math::StackedArray<N, kPoints<N> + N> stack_;
  State mean_ = State::Zero();
  Lower<N> root_ = Lower<N>::Identity();
  static_assert(SigmaRule::isPositive(N));
  double spread_ = SigmaRule::spread(N), other_ = SigmaRule::other(N);
  double sqrt_centre_ = std::sqrt(SigmaRule::centreCovariance(N)), sqrt_other_ = std::sqrt(other_);
  std::uint64_t rescues_ = 0;
};

namespace detail {

template <class Matrix>
bool allFinite(const Matrix& m) {
  double sum = 0.0;  // inf − inf and NaN survive a product with zero
  for (Eigen::Index i = 0; i < m.size(); ++i) sum += 0.0 * m.data()[i];
  return sum == 0.0;
}

/// Solves L z = b by forward substitution.
template <int M>
Eigen::Matrix<double, M, 1> solveLower(const Lower<M>& l, Eigen::Matrix<double, M, 1> b) {
  for (int i = 0; i < M; ++i) {
    for (int j = 0; j < i; ++j) b(i) -= l(i, j) * b(j);
    b(i) /= l(i, i);
  }
  return b;
}

/// Sets stack(i, c) = factor · (values(i, c) − mean(i)) for all points; the centre has its own factor.
template <int Rows, int Points, class Values, class Mean, class Stack>
void deviations(const Values& values, const Mean& mean, double centre_factor, double factor, Stack& stack) {
  for (int i = 0; i < Rows; ++i) {
    const double* from = values.data() + i * Values::ColsAtCompileTime;
    double* to = stack.data() + i * Stack::ColsAtCompileTime;
    for (int c = 0; c < Points; ++c) to[c] = factor * (from[c] - mean(i));
    to[0] = centre_factor * (from[0] - mean(i));
  }
}

/// Weighted mean of the points as centre + w Σ (point − centre), because the weights sum to one.
template <int Rows, int Points, class Values>
Eigen::Matrix<double, Rows, 1> weightedMean(const Values& values, double weight) {
  Eigen::Matrix<double, Rows, 1> mean;
  for (int i = 0; i < Rows; ++i) {
    const double* row = values.data() + i * Values::ColsAtCompileTime;
    double sum = 0.0;
    for (int c = 1; c < Points; ++c) sum += row[c] - row[0];
    mean(i) = row[0] + weight * sum;
  }
  return mean;
}

}  // namespace detail

template <int N>
void SquareRootUkf<N>::reset(const State& mean, const Lower<N>& root) {
  CAPSTAN_ASSERT(detail::allFinite(mean) && detail::allFinite(root));
  mean_ = mean;
  root_ = root;
}

template <int N>
void SquareRootUkf<N>::drawPoints() {
  for (int i = 0; i < N; ++i) {
    double* row = points_.data() + i * kLanes<N>;
    for (int c = 0; c < kLanes<N>; ++c) row[c] = mean_(i);
    for (int j = 0; j <= i; ++j) {
      const double step = spread_ * root_(i, j);
      row[1 + j] += step;
      row[1 + N + j] -= step;
    }
  }
}

template <int N>
void SquareRootUkf<N>::spreadAgain(const Lower<N>& sqrt_q) {
  ++rescues_;
  math::StackedArray<N, 2 * N> wide = math::StackedArray<N, 2 * N>::Zero();
  wide.template leftCols<N>() = root_;
  wide.template middleCols<N>(N) = sqrt_q;
  Lower<N> root;
  alignas(64) math::StackedArray<N, 2 * N> aligned = wide;
  math::triangularise(aligned, root);
  if (detail::allFinite(root)) root_ = root;
}

template <int N>
template <StateModel Model>
bool SquareRootUkf<N>::predict(const Model& model, const typename Model::Input& input, double dt,
                               const Lower<N>& sqrt_q) {
  drawPoints();
  model.propagate(points_, input, dt);

  const State mean = detail::weightedMean<N, kPoints<N>>(points_, other_);
  detail::deviations<N, kPoints<N>>(points_, mean, sqrt_centre_, sqrt_other_, stack_);
  stack_.template middleCols<N>(kPoints<N>) = sqrt_q;
  stack_.template rightCols<decltype(stack_)::ColsAtCompileTime - kPoints<N> - N>().setZero();
  Lower<N> root;
  math::triangularise(stack_, root);

  if (!detail::allFinite(mean) || !detail::allFinite(root)) {
    spreadAgain(sqrt_q);
    return false;
  }
  mean_ = mean;
  root_ = root;
  return true;
}

template <int N>
template <int M>
UpdateReport<M> SquareRootUkf<N>::linearUpdate(const LinearMeasurement<N, M>& measurement,
                                               const Eigen::Matrix<double, M, 1>& y, const Lower<M>& sqrt_r,
                                               bool apply) {
  using Array = math::StackedArray<M + N, M + N>;
  alignas(64) Array array = Array::Zero();
  UpdateReport<M> report;
  report.innovation = y;
  for (int m = 0; m < M; ++m) {
    for (int k = 0; k <= m; ++k) array(m, k) = sqrt_r(m, k);
    for (int k = 0; k < N; ++k) {
      const double h = measurement.h(m, k);
      if (h == 0.0) continue;
      report.innovation(m) -= h * mean_(k);
      for (int j = 0; j <= k; ++j) array(m, M + j) += h * root_(k, j);
    }
  }
  array.template block<N, N>(M, M) = root_;
  Lower<M + N> root;
  math::triangularise(array, root);

  report.root = root.template topLeftCorner<M, M>();
  const Eigen::Matrix<double, M, 1> whitened = detail::solveLower<M>(report.root, report.innovation);
  report.nis = whitened.squaredNorm();
  State mean = mean_;
  for (int i = 0; i < N; ++i)
    for (int m = 0; m < M; ++m) mean(i) += root(M + i, m) * whitened(m);
  report.applied = std::isfinite(report.nis) && detail::allFinite(mean) && detail::allFinite(root);
  if (!apply) return report;
  if (!report.applied) {
    ++rescues_;
    return report;
  }
  mean_ = mean;
  root_ = root.template bottomRightCorner<N, N>();
  return report;
}

template <int N>
template <MeasurementModel<N> Measurement>
UpdateReport<Measurement::kOutputs> SquareRootUkf<N>::update(
    const Measurement& measurement, const Eigen::Matrix<double, Measurement::kOutputs, 1>& y,
    const Lower<Measurement::kOutputs>& sqrt_r) {
  constexpr int M = Measurement::kOutputs;
  constexpr int kAll = kPoints<N>;
  drawPoints();
  OutputPoints<N, M> outputs;
  measurement.observe(points_, outputs);
  const Eigen::Matrix<double, M, 1> expected = detail::weightedMean<M, kAll>(outputs, other_);

  using Stack = math::StackedArray<M, kAll + M>;
  alignas(64) Stack stack = Stack::Zero();
  detail::deviations<M, kAll>(outputs, expected, sqrt_centre_, sqrt_other_, stack);
  const Stack spread_y = stack;
  stack.template middleCols<M>(kAll) = sqrt_r;
  UpdateReport<M> report;
  report.innovation = y - expected;
  math::triangularise(stack, report.root);

  detail::deviations<N, kAll>(points_, mean_, sqrt_centre_, sqrt_other_, stack_);
  const Eigen::Matrix<double, N, M> cross =
      stack_.template leftCols<kAll>() * spread_y.template leftCols<kAll>().transpose();
  const auto triangle = report.root.template triangularView<Eigen::Lower>();
  const Eigen::Matrix<double, M, N> u = triangle.solve(cross.transpose());
  const Eigen::Matrix<double, M, 1> whitened = detail::solveLower<M>(report.root, report.innovation);
  report.nis = whitened.squaredNorm();
  const State mean = mean_ + u.transpose() * whitened;
  Lower<N> root = root_;
  for (int m = 0; m < M && !report.rescued; ++m)
    report.rescued = !math::rankOneDowndate(root, State(u.row(m)));
  if (report.rescued) {
    const Eigen::Matrix<double, N, M> gain =
        report.root.transpose().template triangularView<Eigen::Upper>().solve(u).transpose();
    using Wide = math::StackedArray<N, kAll + M>;
    alignas(64) Wide wide = Wide::Zero();
    wide.template leftCols<kAll>() =
        stack_.template leftCols<kAll>() - gain * spread_y.template leftCols<kAll>();
    wide.template middleCols<M>(kAll) = gain * sqrt_r;
    math::triangularise(wide, root);
  }

  report.applied = std::isfinite(report.nis) && detail::allFinite(mean) && detail::allFinite(root);
  if (report.rescued || !report.applied) ++rescues_;
  if (report.applied) {
    mean_ = mean;
    root_ = root;
  }
  return report;
}

}  // namespace capstan::estimation
