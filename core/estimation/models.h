#pragma once

#include <Eigen/Core>
#include <concepts>

namespace capstan::estimation {

/// Number of sigma points of N states, and the lanes that carry them, a multiple of eight.
template <int N>
inline constexpr int kPoints = 2 * N + 1;
template <int N>
inline constexpr int kLanes = (kPoints<N> + 7) / 8 * 8;

/// Sigma points side by side: row = state, column = point; the centre first, then +S column by column, then
/// −S. Lanes behind the last point repeat the centre, so that they are always legal states. 64-byte aligned
/// where a filter owns it.
template <int N>
using SigmaPoints = Eigen::Matrix<double, N, kLanes<N>, Eigen::RowMajor>;
/// What a measurement model makes of SigmaPoints<N>: M outputs, one column a point.
template <int N, int M>
using OutputPoints = Eigen::Matrix<double, M, kLanes<N>, Eigen::RowMajor>;

/// x(t + dt) = f(x(t), u, dt), all points at once and in place. `Input` is what drives the step from start to
/// end.
template <class Model>
concept StateModel = requires(const Model model, SigmaPoints<Model::kStates>& points,
                              const typename Model::Input& input, double dt) {
  { model.propagate(points, input, dt) } -> std::same_as<void>;
};

/// A state model driven by a sampled control: the step from a sample to the next is `interval`, and `between`
/// gives the control at a fraction in [0, 1] of the way.
template <class Model>
concept SampledStateModel = StateModel<Model> && requires(const typename Model::Control& u, double fraction) {
  { Model::interval(u, u) } -> std::convertible_to<typename Model::Input>;
  { Model::between(u, u, fraction) } -> std::convertible_to<typename Model::Control>;
};

/// y = h(x), all points at once.
template <class Model, int N>
concept MeasurementModel = requires(const Model model, const SigmaPoints<N>& points,
                                    OutputPoints<N, Model::kOutputs>& outputs) {
  { model.observe(points, outputs) } -> std::same_as<void>;
};

/// y = H x. Filters take it without sigma points, exactly.
template <int N, int M>
struct LinearMeasurement {
  static constexpr int kOutputs = M;
  Eigen::Matrix<double, M, N> h = Eigen::Matrix<double, M, N>::Zero();

  void observe(const SigmaPoints<N>& points, OutputPoints<N, M>& outputs) const {
    outputs.noalias() = h * points;
  }
};

}  // namespace capstan::estimation
