#include "core/identification/shooting.h"

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "core/identification/link_kernel.h"

namespace capstan::identification {
namespace {

constexpr double kWarmUpTimes = 10.0;
constexpr double kShortestWarmUp = 15.0, kLongestWarmUp = 30.0;  // [s]

/// The tangents of `set`, in its order.
TangentOrder orderOf(const ParameterSet& set) {
  TangentOrder order;
  for (int k = 0; k < set.size(); ++k)
    order.index[static_cast<std::size_t>(set[k].quantity)][set[k].joint] = k;
  order.count = set.size();
  return order;
}

/// Joints and speeds with unstretched cables: A (q − q_hs) = s_m / r_l.
LinkTangents unstretched(const tracking::CableArmConstants& c, const TangentOrder& order,
                         const MotorStep& motor) {
  Eigen::Matrix3d coupling;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) coupling(i, j) = c.coupling[i][j];
  const Eigen::Matrix3d inverse = coupling.inverse();
  LinkTangents x;
  for (int i = 0; i < 3; ++i) {
    x.value[i] = c.homing[i];
    for (int j = 0; j < 3; ++j) {
      const double q = inverse(i, j) * motor.travel[j] / c.link_radius[j];
      const double dq = inverse(i, j) * motor.rate[j] / c.link_radius[j];
      x.value[i] += q;
      x.value[3 + i] += dq;
      const int tangent = order.index[static_cast<std::size_t>(Quantity::kLinkRadius)][j];
      if (tangent < 0) continue;
      x.by_log[i][tangent] -= q;
      x.by_log[3 + i][tangent] -= dq;
    }
  }
  return x;
}

ArmPrediction predictionOf(const LinkTangents& x) {
  ArmPrediction p;
  for (int i = 0; i < 3; ++i) {
    p.q(i) = x.value[i];
    p.dq(i) = x.value[3 + i];
    for (int k = 0; k < kMostParameters; ++k) {
      p.q_by_log(i, k) = x.by_log[i][k];
      p.dq_by_log(i, k) = x.by_log[3 + i][k];
    }
  }
  return p;
}

/// From motor sample i, `ahead` seconds on, towards sample i + 1.
MotorStep motorStep(const MotorTrack& motors, const tracking::CableArmConstants& c, std::size_t i,
                    double ahead) {
  MotorStep step;
  const std::size_t next = std::min(i + 1, motors.size() - 1);
  const double dt = motors.t[next] - motors.t[i];
  for (int j = 0; j < 3; ++j) {
    const double change = motors.position[next](j) - motors.position[i](j);
    step.rate[j] = dt > 0.0 ? c.motor_scale[j] * change / dt : 0.0;
    step.travel[j] = c.motor_scale[j] * motors.position[i](j) + ahead * step.rate[j];
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
      if (motors.t[motor + 1] - motors.t[motor] > kMotorGap) unbroken = motor + 1;
      ++motor;
    }
    const bool gap_ahead = motor + 1 < motors.size() && motors.t[motor + 1] - motors.t[motor] > kMotorGap;
    if (!seen.open || gap_ahead || seen.t - motors.t[unbroken] < warm_up_) continue;
    const std::size_t start = motors.at(seen.t - warm_up_);
    const bool fresh = pieces_.empty() || pieces_.back().start < unbroken ||
                       seen.t - data.cameras[used_[pieces_.back().first]].t >= options.segment;
    if (fresh) pieces_.push_back({used_.size(), used_.size(), start});
    used_.push_back(i);
    pieces_.back().last = used_.size();
  }
}

void Shooting::run(const Piece& piece, const ParameterSet::Logs& logs, double rate, bool derivatives,
                   std::vector<ArmPrediction>& out) const {
  static const AdvanceLink advanceLink = advanceLinkKernel();
  const MotorTrack& motors = data_.motors;
  const tracking::CableArmConstants constants = set_.constants(logs);
  const TangentOrder order = derivatives ? orderOf(set_) : TangentOrder{};
  std::size_t i = piece.start;
  double t = motors.t[i];
  LinkTangents x = unstretched(constants, order, motorStep(motors, constants, i, 0.0));
  const auto advanceTo = [&](double end) {
    if (!(end > t)) return;
    const MotorStep step = motorStep(motors, constants, i, t - motors.t[i]);
    advanceLink(constants, order, step, end - t, stepsFor(rate, end - t), x);
    t = end;
  };
  for (std::size_t k = piece.first; k < piece.last; ++k) {
    const double at = data_.cameras[used_[k]].t;
    for (; i + 1 < motors.size() && motors.t[i + 1] <= at; ++i) advanceTo(motors.t[i + 1]);
    advanceTo(at);
    out[k] = predictionOf(x);
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
      run(pieces_[piece], logs, rate, derivatives, out);
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
