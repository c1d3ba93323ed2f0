#include "core/identification/shooting.h"

#include <ceres/jet.h>

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "core/identification/link_dynamics.h"

namespace capstan::identification {
namespace {

constexpr double kWarmUpTimes = 10.0;
constexpr double kShortestWarmUp = 15.0, kLongestWarmUp = 30.0;  // [s]
constexpr double kGap = 0.05;                                    // [s] without motor samples: start anew

template <class T>
struct Seed;
template <>
struct Seed<double> {
  static double of(double value, int) { return value; }
};
template <int N>
struct Seed<ceres::Jet<double, N>> {
  /// w = nominal exp(log), d w / d log = w.
  static ceres::Jet<double, N> of(double value, int index) {
    ceres::Jet<double, N> jet(value);
    jet.v(index) = value;
    return jet;
  }
};

template <class T>
LinkParameters<T> seeded(const tracking::CableArmConstants& c, const ParameterSet& set) {
  LinkParameters<T> p{c, {}, {}, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    p.link_radius[i] = T(c.link_radius[i]);
    p.stiffness[i] = T(c.stiffness[i]);
    p.damping[i] = T(c.damping[i]);
    p.coulomb[i] = T(c.coulomb[i]);
  }
  for (int k = 0; k < set.size(); ++k) {
    T& value = fieldOf(p, set[k].quantity)[static_cast<std::size_t>(set[k].joint)];
    if constexpr (std::is_same_v<T, double>)
      value = Seed<T>::of(value, k);
    else
      value = Seed<T>::of(value.a, k);
  }
  return p;
}

void keep(const std::array<double, 3>& x, Eigen::Vector3d& value, ArmPrediction::ByParameter&) {
  value = {x[0], x[1], x[2]};
}
template <int N>
void keep(const std::array<ceres::Jet<double, N>, 3>& x, Eigen::Vector3d& value,
          ArmPrediction::ByParameter& by_log) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    value(row) = x[i].a;
    by_log.row(row).template head<N>() = x[i].v.transpose();
  }
}

std::array<std::array<double, 3>, 3> inverseCoupling(const tracking::CableArmConstants& c) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = c.coupling[i][j];
  a = a.inverse().eval();
  return {{{a(0, 0), a(0, 1), a(0, 2)}, {a(1, 0), a(1, 1), a(1, 2)}, {a(2, 0), a(2, 1), a(2, 2)}}};
}

/// From motor sample i, `ahead` seconds on, towards sample i + 1.
MotorStep motorStep(const MotorTrack& motors, const tracking::CableArmConstants& c, std::size_t i,
                    double ahead) {
  MotorStep step;
  const std::size_t next = std::min(i + 1, motors.size() - 1);
  const double dt = motors.t[next] - motors.t[i];
  for (std::size_t j = 0; j < 3; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const double change = motors.position[next](row) - motors.position[i](row);
    step.rate[j] = dt > 0.0 ? c.motor_scale[j] * change / dt : 0.0;
    step.travel[j] = c.motor_scale[j] * motors.position[i](row) + ahead * step.rate[j];
  }
  return step;
}

int stepsFor(double rate, double dt) { return std::max(1, static_cast<int>(std::ceil(0.5 * rate * dt))); }

/// A short recording gives at most a third of itself.
double warmUpFor(const ParameterSet& set, double duration) {
  return std::min(std::clamp(kWarmUpTimes * set.slowestTime(), kShortestWarmUp, kLongestWarmUp),
                  duration / 3.0);
}

}  // namespace

Shooting::Shooting(const IdentificationData& data, const ParameterSet& set, const ShootingOptions& options)
    : data_(data),
      set_(set),
      options_(options),
      warm_up_(options.warm_up > 0.0 ? options.warm_up : warmUpFor(set, data.duration())) {
  const MotorTrack& motors = data.motors;
  if (motors.size() < 2) return;
  std::size_t unbroken = 0;  // motor sample since when there was no gap
  std::size_t motor = 0;
  for (std::size_t i = 0; i < data.cameras.size(); ++i) {
    const CameraObservation& seen = data.cameras[i];
    while (motor + 1 < motors.size() && motors.t[motor + 1] <= seen.t) {
      if (motors.t[motor + 1] - motors.t[motor] > kGap) unbroken = motor + 1;
      ++motor;
    }
    const bool gap_ahead = motor + 1 < motors.size() && motors.t[motor + 1] - motors.t[motor] > kGap;
    if (!seen.open || gap_ahead || seen.t - motors.t[unbroken] < warm_up_) continue;
    const std::size_t start = motors.at(seen.t - warm_up_);
    const bool fresh = pieces_.empty() || pieces_.back().start < unbroken ||
                       seen.t - data.cameras[used_[pieces_.back().first]].t >= options.segment;
    if (fresh) pieces_.push_back({used_.size(), used_.size(), start});
    used_.push_back(i);
    pieces_.back().last = used_.size();
  }
}

template <class T>
void Shooting::run(const Piece& piece, const ParameterSet::Logs& logs, double rate,
                   std::vector<ArmPrediction>& out) const {
  const MotorTrack& motors = data_.motors;
  const tracking::CableArmConstants constants = set_.constants(logs);
  const LinkParameters<T> parameters = seeded<T>(constants, set_);
  std::size_t i = piece.start;
  double t = motors.t[i];
  LinkState<T> x = unstretched(parameters, motorStep(motors, constants, i, 0.0), inverseCoupling(constants));
  const auto advanceTo = [&](double end) {
    if (!(end > t)) return;
    const MotorStep step = motorStep(motors, constants, i, t - motors.t[i]);
    advanceLink(parameters, step, end - t, stepsFor(rate, end - t), x);
    t = end;
  };
  for (std::size_t k = piece.first; k < piece.last; ++k) {
    const double at = data_.cameras[used_[k]].t;
    for (; i + 1 < motors.size() && motors.t[i + 1] <= at; ++i) advanceTo(motors.t[i + 1]);
    advanceTo(at);
    out[k] = {};
    keep(x.q, out[k].q, out[k].q_by_log);
    keep(x.dq, out[k].dq, out[k].dq_by_log);
  }
}

bool Shooting::predict(const ParameterSet::Logs& logs, bool derivatives, std::vector<ArmPrediction>& out,
                       const base::Progress* progress) const {
  out.resize(used_.size());
  const double rate = set_.rate(logs);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cancelled{false};
  const auto work = [&] {
    for (std::size_t piece = next++; piece < pieces_.size(); piece = next++) {
      if (progress && progress->cancelled()) cancelled = true;
      if (cancelled) return;
      if (!derivatives)
        run<double>(pieces_[piece], logs, rate, out);
      else if (set_.size() <= 2)
        run<ceres::Jet<double, 2>>(pieces_[piece], logs, rate, out);
      else if (set_.size() <= 4)
        run<ceres::Jet<double, 4>>(pieces_[piece], logs, rate, out);
      else if (set_.size() <= 6)
        run<ceres::Jet<double, 6>>(pieces_[piece], logs, rate, out);
      else if (set_.size() <= 8)
        run<ceres::Jet<double, 8>>(pieces_[piece], logs, rate, out);
      else if (set_.size() <= 10)
        run<ceres::Jet<double, 10>>(pieces_[piece], logs, rate, out);
      else
        run<ceres::Jet<double, kMostParameters>>(pieces_[piece], logs, rate, out);
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < options_.threads; ++k) others.emplace_back(work);
    work();
  }
  return !cancelled;
}

}  // namespace capstan::identification
