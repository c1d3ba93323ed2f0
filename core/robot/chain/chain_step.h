#pragma once

#include "core/robot/chain/chain_law.h"

/// Integration of a chain from one row of a recording to the next, for any scalar.
namespace capstan::robot {

/// Integrator for one row. The mass matrix and C dq + G are evaluated once, at the position in the middle of
/// the row that the initial velocity predicts. The motors move so that the speed of their cables is constant.
/// The method is ROS2 (Verwer, Spee, Blom, Hundsdorfer, A second-order Rosenbrock method applied to
/// photochemical dispersion problems, SIAM J. Sci. Comput. 20, 1999), which is of second order for any
/// approximation of the Jacobian. Here this contains the damping D of cables and friction and the stiffness K
/// of cables (without hysteresis), for which the method is L-stable. With γ = 1 − 1/√2, the sum of forces f,
/// the speeds u of the cables' stretches and their lever arms R, W = M + γ h D + γ² h² K:
///     W k_1 = f(t, q, v) + γ h Rᵀ k u(v),        p_1 = v + γ h k_1,
///     W k_2 = f(t + h, q + h p_1, v + h k_1) − 2 M k_1 + γ h Rᵀ k (u(v + h k_1) − 2 u(p_1)),
///     p_2 = v + h k_1 − 2 p_1 + γ h k_2,
///     v += h (3 k_1 + k_2) / 2,                  q += h (3 p_1 + p_2) / 2.
template <class S>
class ChainStep {
 public:
  CAPSTAN_CHAIN_INLINE ChainStep(const ChainShape& shape, const ChainNumbers<S>& numbers)
      : shape_(shape), p_(numbers) {}

  CAPSTAN_CHAIN_INLINE void advance(const ChainInput& input, int steps, ChainState<S>& state) {
    prepare(input, state);
    const double part = 1.0 / steps;
#pragma GCC unroll 1
    for (int step = 0; step < steps; ++step) substep(input, step * part, part, state);
  }

  /// Torque of drives or cables at the joints [N·m or N] and stretch of the cables [m] at the last evaluation
  /// of the forces.
  const S* torque() const { return torque_; }
  const S* stretch() const { return stretch_; }
  const S* acceleration() const { return acceleration_; }

  /// Evaluates the start of the row: sets torque(), stretch() and acceleration().
  CAPSTAN_CHAIN_INLINE void look(const ChainInput& input, const ChainState<S>& state) {
    prepare(input, state);
    ChainState<S> slope;
    forces(input, 0.0, state, slope);
    for (int i = 0; i < shape_.joints; ++i) acceleration_[i] = force_[i];
    factorise<S>(shape_.joints, bodies_.mass);
    solve<S>(shape_.joints, bodies_.mass, acceleration_);
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
      const S measured = input.load[i] + joint.load_sign * (input.signed_load[i] - input.load[i]);
      load_[i] = joint.load_gain * measured + joint.offset;
      if (!shape_.rigid) prepareTravel(input, i);
      if (!shape_.rigid || compliant(i)) continue;
      const S ratio = joint.link_radius / joint.lever;
      const S inertia = joint.motor_inertia * ratio * ratio;
      for (int j = 0; j < shape_.joints; ++j)
        for (int k = 0; k < shape_.joints; ++k)
          bodies_.mass[j][k] = bodies_.mass[j][k] + p_.coupling[i][j] * p_.coupling[i][k] * inertia;
    }
    for (int j = 0; j < shape_.joints && !shape_.rigid; ++j)
      if (shape_.laws[j] & kLawZeroDrift) moveZero(input, j);
  }

  /// Adds the drift of the zero of cable j to its travel, as if its motor had moved by it.
  CAPSTAN_CHAIN_INLINE void moveZero(const ChainInput& input, int j) {
    const S begin = zeroShiftAt(p_.joints[j], input.t).by;
    const S change = zeroShiftAt(p_.joints[j], input.t + input.dt).by - begin;
    const S lever = p_.joints[j].link_radius * p_.coupling[j][j];
    travel_[j] = travel_[j] + lever * begin;
    travel_change_[j] = travel_change_[j] + lever * change;
    travel_rate_[j] = travel_rate_[j] + lever * change * (1.0 / input.dt);
  }

  /// Computes the travel of cable i on the motor's side over the row.
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
    damping_[i] = pull.damping * p.link_radius * p.link_radius;
    stiffness_[i] = pull.stiffness * p.link_radius;
    if (laws & kLawHysteresis) slope.hysteresis[i] = pull.hysteresis_rate;
    if (laws & kLawCreep) slope.creep[i] = pull.creep_rate;
    return pull.force;
  }

  CAPSTAN_CHAIN_INLINE S motorDrive(const ChainInput& input, int i, const S& travel, const S& speed,
                                    const ChainState<S>& x, ChainState<S>& slope) {
    const JointNumbers<S>& p = p_.joints[i];
    const S torque = p.gain * input.torque[i];
    damping_[i] = stiffness_[i] = constantLike(travel, 0.0);
    if (!compliant(i)) {
      stretch_[i] = constantLike(travel, 0.0);
      const S ratio = p.link_radius / p.lever;
      const Opposing<S> friction = motorFriction(p, speed * ratio);
      damping_[i] = friction.slope * ratio * ratio;
      return (torque - friction.force) / p.lever;
    }
    stretch_[i] = p.lever * x.motor[i] - p.link_radius * travel;
    const S force = complianceForce(p, stretch_[i], p.lever * x.motor_rate[i] - p.link_radius * speed);
    slope.motor[i] = x.motor_rate[i];
    slope.motor_rate[i] =
        (torque - motorFriction(p, x.motor_rate[i]).force - p.lever * force) / p.motor_inertia;
    return force;
  }

  /// Computes the sum of forces at the joints, the damping, and the rates of hidden states.
  CAPSTAN_CHAIN_INLINE void forces(const ChainInput& input, double fraction, const ChainState<S>& x,
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
    for (int i = 0; i < n; ++i) {
      const Opposing<S> friction = jointFriction(p_.joints[i], shape_.laws[i], x.q[i], x.dq[i], torque_[i]);
      force_[i] = torque_[i] + load_[i] - bodies_.bias[i] - friction.force;
      joint_damping_[i] = friction.slope;
    }
  }

  /// Computes the factors of M + share D + share² K.
  CAPSTAN_CHAIN_INLINE void factoriseStiff(double share, S (&w)[kChainJoints][kChainJoints]) const {
    const int n = shape_.joints;
    S drive[kChainJoints];
    for (int i = 0; i < n; ++i)
      drive[i] = share * (damping_[i] + share * stiffness_[i] * p_.joints[i].link_radius);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        w[j][k] = bodies_.mass[j][k];
        for (int i = 0; i < n; ++i) w[j][k] = w[j][k] + drive[i] * p_.coupling[i][j] * p_.coupling[i][k];
      }
    for (int j = 0; j < n; ++j) w[j][j] = w[j][j] + share * joint_damping_[j];
    factorise<S>(n, w);
  }

  /// Speeds of the cables' stretches at the joint velocities v, times weight, plus what they were.
  CAPSTAN_CHAIN_INLINE void addStretchSpeeds(double weight, const S* v, S* speeds) const {
    for (int i = 0; i < shape_.joints; ++i) {
      S speed = constantLike(v[0], 0.0);
      for (int j = 0; j < shape_.joints; ++j) speed = speed + p_.coupling[i][j] * v[j];
      speeds[i] = speeds[i] + weight * (travel_rate_[i] - p_.joints[i].link_radius * speed);
    }
  }

  /// Adds the torques of the cables' stiffness, kept from the first stage, for stretches [m].
  CAPSTAN_CHAIN_INLINE void addStiff(const S (&stiffness)[kChainJoints], const S* stretches,
                                     S* torques) const {
    for (int i = 0; i < shape_.joints; ++i)
      for (int j = 0; j < shape_.joints; ++j)
        torques[j] = torques[j] + p_.coupling[i][j] * (stiffness[i] * stretches[i]);
  }

  CAPSTAN_CHAIN_INLINE void substep(const ChainInput& input, double at, double part, ChainState<S>& state) {
    constexpr double kGamma = 0.29289321881345254;  // 1 − 1/√2
    const int n = shape_.joints;
    const double h = input.dt * part, share = kGamma * h;
    ChainState<S> slope, second_slope, end;
    forces(input, at, state, slope);
    S w[kChainJoints][kChainJoints], first[kChainJoints], second[kChainJoints], way[kChainJoints];
    S stiffness[kChainJoints], stretches[kChainJoints];
    factoriseStiff(share, w);
    for (int i = 0; i < n; ++i) {
      first[i] = force_[i];
      stiffness[i] = stiffness_[i];
      stretches[i] = constantLike(force_[i], 0.0);
    }
    if (!shape_.rigid) {
      addStretchSpeeds(share, state.dq, stretches);
      addStiff(stiffness, stretches, first);
    }
    solve<S>(n, w, first);
    for (int i = 0; i < n; ++i) {
      way[i] = state.dq[i] + share * first[i];
      end.q[i] = state.q[i] + h * way[i];
      end.dq[i] = state.dq[i] + h * first[i];
      moveHidden(i, state, h, slope, end);
    }
    forces(input, at + part, end, second_slope);
    for (int i = 0; i < n; ++i) {
      second[i] = force_[i];
      stretches[i] = constantLike(force_[i], 0.0);
      for (int k = 0; k < n; ++k) second[i] = second[i] - 2.0 * bodies_.mass[i][k] * first[k];
    }
    if (!shape_.rigid) {
      addStretchSpeeds(share, end.dq, stretches);
      addStretchSpeeds(-2.0 * share, way, stretches);
      addStiff(stiffness, stretches, second);
    }
    solve<S>(n, w, second);
    for (int i = 0; i < n; ++i) {
      const S second_way = end.dq[i] - 2.0 * way[i] + share * second[i];
      state.q[i] = state.q[i] + (0.5 * h) * (3.0 * way[i] + second_way);
      state.dq[i] = state.dq[i] + (0.5 * h) * (3.0 * first[i] + second[i]);
      moveHidden(i, state, 0.5 * h, slope, state);
      moveHidden(i, state, 0.5 * h, second_slope, state);
    }
    keepInBox(state);
  }

  /// Sets to = from + h by for the hidden states in use.
  CAPSTAN_CHAIN_INLINE void moveHidden(int i, const ChainState<S>& from, double h, const ChainState<S>& by,
                                       ChainState<S>& to) const {
    if (shape_.laws[i] & kLawHysteresis) to.hysteresis[i] = from.hysteresis[i] + h * by.hysteresis[i];
    if (shape_.laws[i] & kLawCreep) to.creep[i] = from.creep[i] + h * by.creep[i];
    if (!compliant(i)) return;
    to.motor[i] = from.motor[i] + h * by.motor[i];
    to.motor_rate[i] = from.motor_rate[i] + h * by.motor_rate[i];
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
  S damping_[kChainJoints], stiffness_[kChainJoints], joint_damping_[kChainJoints], force_[kChainJoints];
  S load_[kChainJoints], torque_[kChainJoints], stretch_[kChainJoints], acceleration_[kChainJoints];
};

}  // namespace capstan::robot
