#pragma once

#include <Eigen/Core>
#include <concepts>

namespace capstan::estimation {

/// Number of sigma points of N states (kPoints), and of lanes that hold them, a multiple of eight (kLanes).
template <int N>
inline constexpr int kPoints = 2 * N + 1;
template <int N>
inline constexpr int kLanes = (kPoints<N> + 7) / 8 * 8;

/// Sigma points as a matrix: one row per state, one column per point. The centre is first, then the centre
/// plus each column of S, then the centre minus each column of S. Lanes after the last point repeat the
/// centre, so that they are always valid states. The matrix is 64-byte aligned inside a filter.
template <int N>
using SigmaPoints = Eigen::Matrix<double, N, kLanes<N>, Eigen::RowMajor>;
/// Output of a measurement model for SigmaPoints<N>: M outputs, one column per point.
template <int N, int M>
using OutputPoints = Eigen::Matrix<double, M, kLanes<N>, Eigen::RowMajor>;

/// State model x(t + dt) = f(x(t), u, dt), for all points at once and in place. `Input` is the input u over
/// the whole step.
template <class Model>
concept StateModel = requires(const Model model, SigmaPoints<Model::kStates>& points,
                              const typename Model::Input& input, double dt) {
  { model.propagate(points, input, dt) } -> std::same_as<void>;
};

/// State model with a sampled control. `interval` returns the Input of the step between two samples,
/// `between` the interpolated control at a fraction in [0, 1] of this step.
template <class Model>
concept SampledStateModel = StateModel<Model> && requires(const typename Model::Control& u, double fraction) {
  { Model::interval(u, u) } -> std::convertible_to<typename Model::Input>;
  { Model::between(u, u, fraction) } -> std::convertible_to<typename Model::Control>;
};

/// Measurement model y = h(x), for all points at once.
template <class Model, int N>
concept MeasurementModel = requires(const Model model, const SigmaPoints<N>& points,
                                    OutputPoints<N, Model::kOutputs>& outputs) {
  { model.observe(points, outputs) } -> std::same_as<void>;
};

/// Linear measurement model y = H x. Filters update with it exactly, without sigma points.
template <int N, int M>
struct LinearMeasurement {
  static constexpr int kOutputs = M;
  Eigen::Matrix<double, M, N> h = Eigen::Matrix<double, M, N>::Zero();

  void observe(const SigmaPoints<N>& points, OutputPoints<N, M>& outputs) const {
    outputs.noalias() = h * points;
  }
};

}  // namespace capstan::estimation
