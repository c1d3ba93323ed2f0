#pragma once

#include "core/robot/chain/chain_law.h"
#include "core/robot/chain/chain_stages.h"

/// How a chain goes from one row of its drive to the next, for any scalar.
namespace capstan::robot {

/// One row's step: the mass matrix and C dq + G are those of the middle of the row, as the start's velocity
/// foretells it, and motors go from one end of the row to the other at a constant speed of their cables;
/// cables and friction, far faster than bodies turn, by a stabilised Runge–Kutta method of second order
/// (chain_stages.h).
template <class S>
class ChainStep {
 public:
  CAPSTAN_CHAIN_INLINE ChainStep(const ChainShape& shape, const ChainNumbers<S>& numbers)
      : shape_(shape), p_(numbers) {}

  CAPSTAN_CHAIN_INLINE void advance(const ChainInput& input, const ChainStages& stages,
                                    ChainState<S>& state) {
    prepare(input, state);
    const double h = input.dt;
    ChainState<S> first, before = state, here = state;  // Y_{j−2} and Y_{j−1}
    slopes(input, 0.0, state, first);
    move(state, stages.first * h, first, here);
#pragma GCC unroll 1
    for (int j = 2; j <= stages.count; ++j) {
      ChainState<S> slope;
      slopes(input, stages.instant[j - 1], here, slope);
      combine(stages, j, h, state, first, slope, here, before);
      swapStates(before, here);
    }
    state = here;
    keepInBox(state);
  }

  /// Torque of drive or cable at the joints [N·m or N] and stretch of the cables [m], of the last slope.
  const S* torque() const { return torque_; }
  const S* stretch() const { return stretch_; }
  const S* acceleration() const { return acceleration_; }

  /// Slopes at the row's start: fills torque(), stretch() and acceleration().
  CAPSTAN_CHAIN_INLINE void look(const ChainInput& input, const ChainState<S>& state) {
    prepare(input, state);
    ChainState<S> slope;
    slopes(input, 0.0, state, slope);
  }

 private:
  CAPSTAN_CHAIN_INLINE bool compliant(int i) const { return (shape_.laws[i] & kLawCompliance) != 0; }

  CAPSTAN_CHAIN_INLINE void prepare(const ChainInput& input, const ChainState<S>& state) {
    S middle[kChainJoints];
    for (int i = 0; i < shape_.joints; ++i) middle[i] = state.q[i] + (0.5 * input.dt) * state.dq[i];
    chainBodies<S>(shape_, p_, middle, state.dq, bodies_);
    for (int i = 0; i < shape_.joints; ++i) {
      bodies_.mass[i][i] = bodies_.mass[i][i] + p_.joints[i].armature;
      const JointNumbers<S>& joint = p_.joints[i];
      load_[i] = input.load[i] + joint.load_sign * (input.signed_load[i] - input.load[i]);
      if (!shape_.rigid) prepareTravel(input, i);
      if (!shape_.rigid || compliant(i)) continue;
      const S ratio = joint.link_radius / joint.lever;
      const S inertia = joint.motor_inertia * ratio * ratio;
      for (int j = 0; j < shape_.joints; ++j)
        for (int k = 0; k < shape_.joints; ++k)
          bodies_.mass[j][k] = bodies_.mass[j][k] + p_.coupling[i][j] * p_.coupling[i][k] * inertia;
    }
    factorise<S>(shape_.joints, bodies_.mass);
  }

  /// Motor's side of a cable over the row.
  CAPSTAN_CHAIN_INLINE void prepareTravel(const ChainInput& input, int i) {
    const JointNumbers<S>& p = p_.joints[i];
    const unsigned laws = shape_.laws[i];
    S begin = constantLike(p.lever, input.motor[i]), end = constantLike(p.lever, input.motor_end[i]);
    if (laws & kLawSlip) {
      begin = begin + slipAt(p, input.t);
      end = end + slipAt(p, input.t + input.dt);
    }
    travel_[i] = motorTravel(p, laws, begin);
    travel_change_[i] = motorTravel(p, laws, end) - travel_[i];
    travel_rate_[i] = travel_change_[i] * (1.0 / input.dt);
  }

  CAPSTAN_CHAIN_INLINE S cableDrive(int i, double fraction, const S& travel, const S& speed,
                                    const ChainState<S>& x, ChainState<S>& slope) {
    const JointNumbers<S>& p = p_.joints[i];
    const unsigned laws = shape_.laws[i];
    const S position = travel_[i] + fraction * travel_change_[i];
    const S range = (x.q[i] - shape_.middle[i]) * shape_.inverse_half_range[i];
    stretch_[i] = position - p.link_radius * travel;
    const CablePull<S> pull = cablePull(p, laws, stretch_[i], travel_rate_[i] - p.link_radius * speed, range,
                                        x.hysteresis[i], x.creep[i]);
    if (laws & kLawHysteresis) slope.hysteresis[i] = pull.hysteresis_rate;
    if (laws & kLawCreep) slope.creep[i] = pull.creep_rate;
    return pull.force;
  }

  CAPSTAN_CHAIN_INLINE S motorDrive(const ChainInput& input, int i, const S& travel, const S& speed,
                                    const ChainState<S>& x, ChainState<S>& slope) {
    const JointNumbers<S>& p = p_.joints[i];
    const S torque = p.gain * input.torque[i];
    if (!compliant(i)) {
      stretch_[i] = constantLike(travel, 0.0);
      return (torque - motorFriction(p, speed * p.link_radius / p.lever)) / p.lever;
    }
    stretch_[i] = p.lever * x.motor[i] - p.link_radius * travel;
    const S force = complianceForce(p, stretch_[i], p.lever * x.motor_rate[i] - p.link_radius * speed);
    slope.motor[i] = x.motor_rate[i];
    slope.motor_rate[i] = (torque - motorFriction(p, x.motor_rate[i]) - p.lever * force) / p.motor_inertia;
    return force;
  }

  CAPSTAN_CHAIN_INLINE void slopes(const ChainInput& input, double fraction, const ChainState<S>& x,
                                   ChainState<S>& slope) {
    const int n = shape_.joints;
    for (int j = 0; j < n; ++j) torque_[j] = constantLike(x.q[0], 0.0);
    for (int i = 0; i < n; ++i) {
      S travel = constantLike(x.q[0], 0.0), speed = travel;
      for (int j = 0; j < n; ++j) {
        travel = travel + p_.coupling[i][j] * (x.q[j] - p_.joints[j].homing);
        speed = speed + p_.coupling[i][j] * x.dq[j];
      }
      const S pull = shape_.rigid ? motorDrive(input, i, travel, speed, x, slope)
                                  : cableDrive(i, fraction, travel, speed, x, slope);
      const S force = p_.joints[i].link_radius * pull;
      for (int j = 0; j < n; ++j) torque_[j] = torque_[j] + p_.coupling[i][j] * force;
    }
    for (int i = 0; i < n; ++i)
      acceleration_[i] = torque_[i] + load_[i] - bodies_.bias[i] -
                         jointFriction(p_.joints[i], shape_.laws[i], x.q[i], x.dq[i], torque_[i]);
    solve<S>(n, bodies_.mass, acceleration_);
    for (int i = 0; i < n; ++i) {
      slope.q[i] = x.dq[i];
      slope.dq[i] = acceleration_[i];
    }
  }

  /// to = from + h by, of what takes part.
  CAPSTAN_CHAIN_INLINE void move(const ChainState<S>& from, double h, const ChainState<S>& by,
                                 ChainState<S>& to) const {
    for (int i = 0; i < shape_.joints; ++i) {
      to.q[i] = from.q[i] + h * by.q[i];
      to.dq[i] = from.dq[i] + h * by.dq[i];
      if (shape_.laws[i] & kLawHysteresis) to.hysteresis[i] = from.hysteresis[i] + h * by.hysteresis[i];
      if (shape_.laws[i] & kLawCreep) to.creep[i] = from.creep[i] + h * by.creep[i];
      if (!compliant(i)) continue;
      to.motor[i] = from.motor[i] + h * by.motor[i];
      to.motor_rate[i] = from.motor_rate[i] + h * by.motor_rate[i];
    }
  }

  /// Y_j in place of Y_{j−2}.
  CAPSTAN_CHAIN_INLINE void combine(const ChainStages& k, int j, double h, const ChainState<S>& start,
                                    const ChainState<S>& first, const ChainState<S>& slope,
                                    const ChainState<S>& here, ChainState<S>& before) const {
    const double rest = 1.0 - k.mu[j] - k.nu[j], by = k.mu_slope[j] * h, by_first = k.gamma[j] * h;
    const auto mix = [&](const S& y0, const S& f0, const S& f, const S& y1, S& y2) {
      y2 = rest * y0 + k.mu[j] * y1 + k.nu[j] * y2 + by * f + by_first * f0;
    };
    for (int i = 0; i < shape_.joints; ++i) {
      mix(start.q[i], first.q[i], slope.q[i], here.q[i], before.q[i]);
      mix(start.dq[i], first.dq[i], slope.dq[i], here.dq[i], before.dq[i]);
      if (shape_.laws[i] & kLawHysteresis)
        mix(start.hysteresis[i], first.hysteresis[i], slope.hysteresis[i], here.hysteresis[i],
            before.hysteresis[i]);
      if (shape_.laws[i] & kLawCreep)
        mix(start.creep[i], first.creep[i], slope.creep[i], here.creep[i], before.creep[i]);
      if (!compliant(i)) continue;
      mix(start.motor[i], first.motor[i], slope.motor[i], here.motor[i], before.motor[i]);
      mix(start.motor_rate[i], first.motor_rate[i], slope.motor_rate[i], here.motor_rate[i],
          before.motor_rate[i]);
    }
  }

  CAPSTAN_CHAIN_INLINE void swapStates(ChainState<S>& a, ChainState<S>& b) const {
    const ChainState<S> kept = a;
    a = b;
    b = kept;
  }

  CAPSTAN_CHAIN_INLINE void keepInBox(ChainState<S>& x) const {
    for (int i = 0; i < shape_.joints; ++i) {
      x.q[i] = shape_.middle[i] + clipped(x.q[i] - shape_.middle[i], shape_.farthest[i]);
      x.dq[i] = clipped(x.dq[i], shape_.fastest[i]);
    }
  }

  const ChainShape& shape_;
  const ChainNumbers<S>& p_;
  ChainBodies<S> bodies_;
  S travel_[kChainJoints], travel_change_[kChainJoints], travel_rate_[kChainJoints];
  S load_[kChainJoints], torque_[kChainJoints], stretch_[kChainJoints], acceleration_[kChainJoints];
};

}  // namespace capstan::robot
