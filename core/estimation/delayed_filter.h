#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/estimation/square_root_ukf.h"

namespace capstan::estimation {

/// Why a measurement found no state of its own time.
enum class LateFault { kNotStarted, kTooOld };

/// A square-root UKF that remembers. Controls (motor samples) come in order; a measurement comes whenever it
/// comes and is applied to the state of its own time, between two controls if need be, and everything later
/// is replayed, other measurements included. The outcome is that of processing in order of time.
///
/// A measurement newer than the newest control is applied at once with that control held, and again with the
/// interpolated one when the next control is there. `density` is a square root of the process noise per
/// second: a step of dt adds density densityᵀ dt; a model with density(input, density) may change it. Times
/// in seconds; no allocation after construction.
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

  /// Remembers the last `capacity` (at least 2) controls and measurements.
  DelayedFilter(Model model, const Lower<kStates>& density, int capacity, const SigmaRule& rule = {})
      : model_(std::move(model)),
        density_(density),
        filter_(rule),
        scratch_(rule),
        ring_(capacity < 2 ? 2 : capacity) {}

  /// Forgets everything and starts at time t.
  void reset(double t, const State& mean, const Lower<kStates>& root, const Control& control);
  bool started() const { return size_ > 0; }

  /// Predicts to a new control. False, and nothing done, before reset(), unless t is later than the newest
  /// control's time, or when the memory is full of measurements newer than that control.
  bool advance(double t, const Control& control);

  /// Takes a measurement of time t; the report is that of its own time.
  base::Result<Report, LateFault> update(double t, const Measurement& measurement, const Output& y,
                                         const Lower<kOutputs>& sqrt_r);
  /// The report that update() would give (LinearMeasurement only); nothing changes. What a gate asks first.
  base::Result<Report, LateFault> peek(double t, const Measurement& measurement, const Output& y,
                                       const Lower<kOutputs>& sqrt_r);
  /// What came at or after `since` was not what it seemed: `control(u)` corrects each control remembered from
  /// there on, `state(mean, root)` the state before them (what is known then may be less), and everything is
  /// replayed. Reaches no further back than the memory.
  template <class ChangeControl, class ChangeState>
  void revise(double since, ChangeControl control, ChangeState state);
  /// The filter as it stood at time t, with what is known now of the time up to t.
  base::Result<const Filter*, LateFault> at(double t);

  /// Newest state, at time().
  const State& mean() const { return filter_.mean(); }
  const Lower<kStates>& squareRoot() const { return filter_.squareRoot(); }
  Eigen::Matrix<double, kStates, kStates> covariance() const { return filter_.covariance(); }
  double time() const { return size_ > 0 ? entry(size_ - 1).t : 0.0; }
  /// Fallbacks, those of replays included.
  std::uint64_t rescues() const { return filter_.rescues(); }

  /// Parameters may be changed between steps; the remembered past stays as it was until replayed.
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

  /// Index of the last entry at or before t; −1: none.
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
  /// A full memory drops its oldest entry, which must not be the one that a new entry starts from.
  bool hasRoomBehind(int i) const { return i > 0 || size_ < capacity(); }
  int insertBehind(int i);
  void predictTo(Filter& filter, const Entry& from, double t, const Control& control);
  Control controlAt(int before, double t) const;
  Report replayFrom(int i, int reported);

  Model model_;
  Lower<kStates> density_;
  Filter filter_;   ///< the newest state, and what replays
  Filter scratch_;  ///< what looks back
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

/// Opens a place behind entry i, dropping the oldest entry when the memory is full; returns the place's
/// index.
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

/// Control at time t, which lies at or behind entry `before`: between it and the next entry, held behind the
/// last.
template <SampledStateModel Model, class Measurement>
typename Model::Control DelayedFilter<Model, Measurement>::controlAt(int before, double t) const {
  const Entry& left = entry(before);
  if (before + 1 >= size_) return left.control;
  const Entry& right = entry(before + 1);
  if (!(right.t > left.t)) return left.control;
  return Model::between(left.control, right.control, (t - left.t) / (right.t - left.t));
}

/// Recomputes entries i … newest; the report is that of the measurement at entry `reported`.
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
