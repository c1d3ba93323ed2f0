#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/estimation/square_root_ukf.h"

namespace capstan::estimation {

/// Reason why the filter has no state at the time of a measurement.
enum class LateFault { kNotStarted, kTooOld };

/// Square-root UKF for delayed measurements. Controls (motor samples) arrive in order of time; measurements
/// may arrive at any time. A measurement is applied to the state at its own time, which may lie between two
/// controls, and all later controls and measurements are replayed. The result is that of processing in order
/// of time.
///
/// A measurement newer than the newest control is applied at once with that control held. When the next
/// control arrives, it is applied again with the interpolated control. `density` is a square root of the
/// process noise per second: a step of dt adds density densityᵀ dt. A model with density(input, density) may
/// change it. Times are in seconds. No allocation after construction.
template <SampledStateModel Model, class Measurement>
class DelayedFilter {
 public:
  static constexpr int kStates = Model::kStates;
  static constexpr int kOutputs = Measurement::kOutputs;
  using Filter = SquareRootUkf<kStates>;
  using State = typename Filter::State;
  using Control = typename Model::Control;
  using Output = Eigen::Matrix<double, kOutputs, 1>;
  using Report = UpdateReport<kOutputs>;

  /// Stores the last `capacity` (at least 2) controls and measurements for replays.
  DelayedFilter(Model model, const Lower<kStates>& density, int capacity)
      : model_(std::move(model)), density_(density), ring_(capacity < 2 ? 2 : capacity) {}

  /// Forgets everything and starts at time t.
  void reset(double t, const State& mean, const Lower<kStates>& root, const Control& control);
  bool started() const { return size_ > 0; }

  /// Predicts to the time t of a new control. Returns false and changes nothing before reset(), when t is not
  /// later than the newest control, or when the memory is full of measurements newer than that control.
  bool advance(double t, const Control& control);

  /// Applies a measurement of time t and replays what is later. The report is that of the update at time t.
  base::Result<Report, LateFault> update(double t, const Measurement& measurement, const Output& y,
                                         const Lower<kOutputs>& sqrt_r);
  /// Returns the report that update() would return, without a change of the state; a gate uses it. Only for a
  /// LinearMeasurement.
  base::Result<Report, LateFault> peek(double t, const Measurement& measurement, const Output& y,
                                       const Lower<kOutputs>& sqrt_r);
  /// Corrects the stored past from time `since` on and replays it: `control(u)` corrects each stored control
  /// from there on, and `state(mean, root)` the state before them, for example by a larger covariance.
  /// Reaches back only as far as the memory.
  template <class ChangeControl, class ChangeState>
  void revise(double since, ChangeControl control, ChangeState state);
  /// Returns the filter at time t, with all measurements up to t that have arrived so far.
  base::Result<const Filter*, LateFault> at(double t);

  /// Mean of the newest state, at time().
  const State& mean() const { return filter_.mean(); }
  const Lower<kStates>& squareRoot() const { return filter_.squareRoot(); }
  Eigen::Matrix<double, kStates, kStates> covariance() const { return filter_.covariance(); }
  double time() const { return size_ > 0 ? entry(size_ - 1).t : 0.0; }
  /// Number of fallbacks, including those in replays.
  std::uint64_t rescues() const { return filter_.rescues(); }

  /// Model; its parameters may change between steps. The stored past changes only when it is replayed.
  Model& model() { return model_; }
  const Model& model() const { return model_; }

 private:
  struct Entry {
    double t = 0.0;
    Control control{};
    bool is_control = true;
    Measurement measurement{};
    Output y = Output::Zero();
    Lower<kOutputs> sqrt_r = Lower<kOutputs>::Zero();
    State mean = State::Zero();
    Lower<kStates> root = Lower<kStates>::Zero();
  };

  Entry& entry(int i) { return ring_[static_cast<std::size_t>((first_ + i) % capacity())]; }
  const Entry& entry(int i) const { return ring_[static_cast<std::size_t>((first_ + i) % capacity())]; }
  int capacity() const { return static_cast<int>(ring_.size()); }

  /// Index of the last entry at or before t; −1 when there is none.
  int lastUpTo(double t) const {
    int i = size_ - 1;
    while (i >= 0 && entry(i).t > t) --i;
    return i;
  }
  int lastControl(int before) const {
    int i = before;
    while (i > 0 && !entry(i).is_control) --i;
    return i;
  }
  /// Whether an entry can be added behind entry i. A full memory drops its oldest entry, which must not be i.
  bool hasRoomBehind(int i) const { return i > 0 || size_ < capacity(); }
  int insertBehind(int i);
  void predictTo(Filter& filter, const Entry& from, double t, const Control& control);
  Control controlAt(int before, double t) const;
  Report replayFrom(int i, int reported);

  Model model_;
  Lower<kStates> density_;
  Filter filter_;   ///< newest state; also used for replays
  Filter scratch_;  ///< past states, for at() and peek()
  std::vector<Entry> ring_;
  int first_ = 0;
  int size_ = 0;
};

template <SampledStateModel Model, class Measurement>
void DelayedFilter<Model, Measurement>::reset(double t, const State& mean, const Lower<kStates>& root,
                                              const Control& control) {
  first_ = 0;
  size_ = 1;
  Entry& start = entry(0);
  start.t = t;
  start.control = control;
  start.is_control = true;
  start.mean = mean;
  start.root = root;
  filter_.reset(mean, root);
}

/// Inserts an empty entry behind entry i and returns its index. A full memory drops its oldest entry.
template <SampledStateModel Model, class Measurement>
int DelayedFilter<Model, Measurement>::insertBehind(int i) {
  if (size_ == capacity()) {
    first_ = (first_ + 1) % capacity();
    --size_;
    --i;
  }
  ++size_;
  for (int k = size_ - 1; k > i + 1; --k) entry(k) = entry(k - 1);
  return i + 1;
}

template <SampledStateModel Model, class Measurement>
void DelayedFilter<Model, Measurement>::predictTo(Filter& filter, const Entry& from, double t,
                                                  const Control& control) {
  const double dt = t - from.t;
  if (!(dt > 0.0)) return;
  const typename Model::Input input = Model::interval(from.control, control);
  if constexpr (requires { model_.density(input, density_); })
    filter.predict(model_, input, dt, model_.density(input, density_) * std::sqrt(dt));
  else
    filter.predict(model_, input, dt, density_ * std::sqrt(dt));
}

/// Control at time t, at or after entry `before`: interpolated up to the next entry, held after the last one.
template <SampledStateModel Model, class Measurement>
typename Model::Control DelayedFilter<Model, Measurement>::controlAt(int before, double t) const {
  const Entry& left = entry(before);
  if (before + 1 >= size_) return left.control;
  const Entry& right = entry(before + 1);
  if (!(right.t > left.t)) return left.control;
  return Model::between(left.control, right.control, (t - left.t) / (right.t - left.t));
}

/// Recomputes the entries from i to the newest. Returns the report of the measurement at entry `reported`.
template <SampledStateModel Model, class Measurement>
auto DelayedFilter<Model, Measurement>::replayFrom(int i, int reported) -> Report {
  Report report;
  filter_.reset(entry(i - 1).mean, entry(i - 1).root);
  for (int k = i; k < size_; ++k) {
    Entry& now = entry(k);
    predictTo(filter_, entry(k - 1), now.t, now.control);
    if (!now.is_control) {
      const Report taken = filter_.update(now.measurement, now.y, now.sqrt_r);
      if (k == reported) report = taken;
    }
    now.mean = filter_.mean();
    now.root = filter_.squareRoot();
  }
  return report;
}

template <SampledStateModel Model, class Measurement>
bool DelayedFilter<Model, Measurement>::advance(double t, const Control& control) {
  if (!started()) return false;
  const int before = lastControl(size_ - 1);
  const double t_before = entry(before).t;
  const Control control_before = entry(before).control;
  if (!(t > t_before) || !hasRoomBehind(lastUpTo(t))) return false;

  const int place = insertBehind(lastUpTo(t));
  Entry& added = entry(place);
  added.t = t;
  added.control = control;
  added.is_control = true;
  int from = place;
  for (int k = place - 1; k > 0 && entry(k).t > t_before && !entry(k).is_control; --k) {
    entry(k).control = Model::between(control_before, control, (entry(k).t - t_before) / (t - t_before));
    from = k;
  }
  for (int k = place + 1; k < size_; ++k) entry(k).control = control;
  replayFrom(from, -1);
  return true;
}

template <SampledStateModel Model, class Measurement>
template <class ChangeControl, class ChangeState>
void DelayedFilter<Model, Measurement>::revise(double since, ChangeControl control, ChangeState state) {
  if (!started()) return;
  const int first = std::max(lastUpTo(since), 0);
  for (int k = first; k < size_; ++k) control(entry(k).control);
  state(entry(first).mean, entry(first).root);
  filter_.reset(entry(first).mean, entry(first).root);
  if (first + 1 < size_) replayFrom(first + 1, -1);
}

template <SampledStateModel Model, class Measurement>
auto DelayedFilter<Model, Measurement>::at(double t) -> base::Result<const Filter*, LateFault> {
  if (!started()) return base::failure(LateFault::kNotStarted);
  const int before = lastUpTo(t);
  if (before < 0) return base::failure(LateFault::kTooOld);
  scratch_.reset(entry(before).mean, entry(before).root);
  predictTo(scratch_, entry(before), t, controlAt(before, t));
  return &scratch_;
}

template <SampledStateModel Model, class Measurement>
auto DelayedFilter<Model, Measurement>::peek(double t, const Measurement& measurement, const Output& y,
                                             const Lower<kOutputs>& sqrt_r)
    -> base::Result<Report, LateFault> {
  const auto state = at(t);
  if (!state) return base::failure(state.error());
  return scratch_.peek(measurement, y, sqrt_r);
}

template <SampledStateModel Model, class Measurement>
auto DelayedFilter<Model, Measurement>::update(double t, const Measurement& measurement, const Output& y,
                                               const Lower<kOutputs>& sqrt_r)
    -> base::Result<Report, LateFault> {
  if (!started()) return base::failure(LateFault::kNotStarted);
  const int before = lastUpTo(t);
  if (before < 0) return base::failure(LateFault::kTooOld);
  if (!hasRoomBehind(before)) return base::failure(LateFault::kTooOld);
  const Control control = controlAt(before, t);
  const int place = insertBehind(before);
  Entry& added = entry(place);
  added.t = t;
  added.control = control;
  added.is_control = false;
  added.measurement = measurement;
  added.y = y;
  added.sqrt_r = sqrt_r;
  return replayFrom(place, place);
}

}  // namespace capstan::estimation
