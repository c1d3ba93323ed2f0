#pragma once

#include "core/robot/chain/chain_law.h"

/// How a chain goes from one row of its drive to the next, for any scalar.
namespace capstan::robot {

/// One row's step: the mass matrix and C dq + G are those of the middle of the row, as the start's velocity
/// foretells it; the rest is classical Runge–Kutta in sub-steps, for cables and friction are far faster than
/// bodies turn.
template <class S>
class ChainStep {
 public:
  CAPSTAN_CHAIN_INLINE ChainStep(const ChainShape& shape, const ChainNumbers<S>& numbers)
      : shape_(shape), p_(numbers) {}

  CAPSTAN_CHAIN_INLINE void advance(const ChainInput& input, int steps, ChainState<S>& state) {
    prepare(input, state);
    const double part = 1.0 / steps, h = input.dt * part;
    for (int step = 0; step < steps; ++step) {
      substep(input, step * part, part, h, state);
      keepInBox(state);
    }
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
      if (!shape_.rigid || compliant(i)) continue;
      const S ratio = joint.link_radius / joint.lever;
      const S inertia = joint.motor_inertia * ratio * ratio;
      for (int j = 0; j < shape_.joints; ++j)
        for (int k = 0; k < shape_.joints; ++k)
          bodies_.mass[j][k] = bodies_.mass[j][k] + p_.coupling[i][j] * p_.coupling[i][k] * inertia;
    }
    factorise<S>(shape_.joints, bodies_.mass);
  }

  CAPSTAN_CHAIN_INLINE S cableDrive(const ChainInput& input, int i, double fraction, const S& travel,
                                    const S& speed, const ChainState<S>& x, ChainState<S>& slope) {
    const JointNumbers<S>& p = p_.joints[i];
    const unsigned laws = shape_.laws[i];
    S angle = constantLike(travel, input.motor[i] + fraction * (input.motor_end[i] - input.motor[i]));
    S rate = constantLike(travel, (input.motor_end[i] - input.motor[i]) / input.dt);
    if (laws & kLawSlip) {
      const S before = slipAt(p, input.t), after = slipAt(p, input.t + input.dt);
      angle = angle + before + fraction * (after - before);
      rate = rate + (after - before) * (1.0 / input.dt);
    }
    const MotorTravel<S> motor = motorTravel(p, laws, angle, rate);
    const S range = (x.q[i] - shape_.middle[i]) * shape_.inverse_half_range[i];
    stretch_[i] = motor.position - p.link_radius * travel;
    const CablePull<S> pull = cablePull(p, laws, stretch_[i], motor.velocity - p.link_radius * speed, range,
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
                                  : cableDrive(input, i, fraction, travel, speed, x, slope);
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

  CAPSTAN_CHAIN_INLINE void substep(const ChainInput& input, double at, double part, double h,
                                    ChainState<S>& state) {
    constexpr double kInstant[] = {0.0, 0.5, 0.5, 1.0};
    constexpr double kReach[] = {0.5, 0.5, 1.0, 0.0};
    constexpr double kWeight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const ChainState<S> start = state;
    ChainState<S> stage = state;
#pragma GCC unroll 1
    for (int k = 0; k < 4; ++k) {
      ChainState<S> slope;
      slopes(input, at + kInstant[k] * part, stage, slope);
      move(state, kWeight[k] * h, slope, state);
      move(start, kReach[k] * h, slope, stage);
    }
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
  S load_[kChainJoints], torque_[kChainJoints], stretch_[kChainJoints], acceleration_[kChainJoints];
};

}  // namespace capstan::robot
