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

/// Order of the tangents of `set`.
TangentOrder orderOf(const ParameterSet& set) {
  TangentOrder order;
  for (int k = 0; k < set.size(); ++k)
    order.index[static_cast<std::size_t>(set[k].quantity)][set[k].joint] = k;
  order.count = set.size();
  return order;
}

/// State with unstretched cables: A (q − q_hs) = s_m / r_l.
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

/// Hysteresis of each cable that is not part of the model (model_discrepancy.h): a force that grows with the
/// stretch and slips at the limit of Coulomb friction, Prandtl's stop operator
///     z ← clamp(z + Δ stretch / yield, −1, 1).
/// The link responds to it with first order; damping and creeping friction give the time constant
///     τ(dq) = (2 b_e r_l² + F_vl + F_cl / v_eps (1 − tanh²(dq / v_eps))) / (2 k_e a r_l²).
struct UnknownHysteresis {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), response = Eigen::Vector3d::Zero();

  void advance(const tracking::CableArmConstants& c, const MotorStep& motor, const LinkTangents& x,
               double dt) {
    for (int i = 0; i < 3; ++i) {
      if (!(c.coulomb[i] > 0.0)) continue;
      const double r = c.link_radius[i], stiffness = 2.0 * c.stiffness[i] * c.exponent[i] * r * r;
      double rate = motor.rate[i];  // rate of the stretch [m/s]
      for (int j = 0; j < 3; ++j) rate -= r * c.coupling[i][j] * x.value[3 + j];
      force(i) = std::clamp(force(i) + dt * rate * stiffness / (r * c.coulomb[i]), -1.0, 1.0);
      const double sign = std::tanh(x.value[3 + i] * c.inverse_smoothing[i]);
      const double creep = c.coulomb[i] * c.inverse_smoothing[i] * (1.0 - sign * sign);
      const double time = (2.0 * c.damping[i] * r * r + c.viscous[i] + creep) / stiffness;
      response(i) += -std::expm1(-dt / time) * (force(i) - response(i));
    }
  }
};

ArmPrediction predictionOf(const LinkTangents& x, const Eigen::Vector3d& hysteresis) {
  ArmPrediction p;
  p.hysteresis = hysteresis;
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

/// Motor step that starts `ahead` seconds after motor sample i, towards sample i + 1.
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

/// Range of motor samples without a gap, and its warm-up [s].
struct Segment {
  std::size_t first = 0, last = 0;
  double warm_up = 0.0;
};

std::vector<Segment> segmentsOf(const MotorTrack& motors, const ParameterSet& set, double warm_up) {
  const double forgotten = std::clamp(kWarmUpTimes * set.slowestTime(), kShortestWarmUp, kLongestWarmUp);
  std::vector<Segment> all;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    if (all.empty() || motors.t[i] - motors.t[i - 1] > kMotorGap) all.push_back({i, i});
    all.back().last = i;
  }
  for (Segment& segment : all) {
    const double third = (motors.t[segment.last] - motors.t[segment.first]) / 3.0;
    segment.warm_up = warm_up > 0.0 ? warm_up : std::min(forgotten, third);
  }
  return all;
}

}  // namespace

Shooting::Shooting(const IdentificationData& data, const ParameterSet& set, const ShootingOptions& options)
    : data_(data), set_(set), options_(options) {
  const MotorTrack& motors = data.motors;
  if (motors.size() < 2) return;
  std::size_t i = 0;
  for (const Segment& segment : segmentsOf(motors, set, options.warm_up)) {
    const double from = motors.t[segment.first] + segment.warm_up, to = motors.t[segment.last];
    bool fresh = true;
    for (; i < data.cameras.size() && data.cameras[i].t <= to; ++i) {
      const CameraObservation& seen = data.cameras[i];
      if (!seen.open || seen.t < from) continue;
      if (fresh || seen.t - data.cameras[used_[pieces_.back().first]].t >= options.segment)
        pieces_.push_back({used_.size(), used_.size(), motors.at(seen.t - segment.warm_up)});
      fresh = false;
      used_.push_back(i);
      segment_.push_back(segment.first);
      pieces_.back().last = used_.size();
    }
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
  UnknownHysteresis hysteresis;
  const auto advanceTo = [&](double end) {
    if (!(end > t)) return;
    const MotorStep step = motorStep(motors, constants, i, t - motors.t[i]);
    advanceLink(constants, order, step, end - t, stepsFor(rate, end - t), x);
    if (derivatives) hysteresis.advance(constants, step, x, end - t);
    t = end;
  };
  for (std::size_t k = piece.first; k < piece.last; ++k) {
    const double at = data_.cameras[used_[k]].t;
    for (; i + 1 < motors.size() && motors.t[i + 1] <= at; ++i) advanceTo(motors.t[i + 1]);
    advanceTo(at);
    out[k] = predictionOf(x, hysteresis.response);
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
