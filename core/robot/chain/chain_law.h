#pragma once

#include <cmath>

#include "core/robot/chain/chain_bodies.h"
#include "core/robot/chain/chain_numbers.h"

/// Laws of transmission, cable and friction of a joint with every effect that a robot file can have, for any
/// scalar. Plant, filter and diagnosis all use these laws; there is no second implementation.
namespace capstan::robot {

CAPSTAN_CHAIN_INLINE double whereGreater(double x, double y, double yes, double no) {
  return x > y ? yes : no;
}
CAPSTAN_CHAIN_INLINE double constantLike(double, double value) { return value; }

template <class S>
CAPSTAN_CHAIN_INLINE S positivePart(const S& x) {
  const S zero = constantLike(x, 0.0);
  return whereGreater(x, zero, x, zero);
}
/// Returns x limited to ±limit.
template <class S>
CAPSTAN_CHAIN_INLINE S clipped(const S& x, double limit) {
  const S high = constantLike(x, limit), low = constantLike(x, -limit);
  const S below = whereGreater(x, high, high, x);
  return whereGreater(low, below, low, below);
}

/// Travel of a cable on the motor's side [m],
///     s_m = r_mc q_m / N + e_c sin φ + e_s (cos φ − 1), φ = q_m / N.
/// A capstan with the eccentricity (e_c, e_s) has the effective radius r_mc + e_c cos φ − e_s sin φ.
template <class S>
CAPSTAN_CHAIN_INLINE S motorTravel(const JointNumbers<S>& p, unsigned laws, const S& angle) {
  using std::cos, std::sin;
  S travel = p.lever * angle;
  if (laws & kLawEccentricity) {
    const S phi = angle * p.inverse_gear;
    travel = travel + p.eccentric_cosine * sin(phi) + p.eccentric_sine * (cos(phi) - 1.0);
  }
  return travel;
}

/// Lever d s_m / d q_m [m/rad]: velocity of the cable per velocity of the motor, and torque on the motor per
/// force of the cable.
template <class S>
CAPSTAN_CHAIN_INLINE S motorLever(const JointNumbers<S>& p, unsigned laws, const S& angle) {
  using std::cos, std::sin;
  if (!(laws & kLawEccentricity)) return p.lever;
  const S phi = angle * p.inverse_gear;
  return p.lever + (p.eccentric_cosine * cos(phi) - p.eccentric_sine * sin(phi)) * p.inverse_gear;
}

/// Deficit of the motor's reading at time t [rad]: slip times a smooth step from slip_time over kSlipTime.
inline constexpr double kSlipTime = 0.05;  // duration of the step [s]
template <class S>
CAPSTAN_CHAIN_INLINE S slipAt(const JointNumbers<S>& p, double t) {
  const S one = constantLike(p.slip, 1.0);
  const S x = positivePart((t - p.slip_time) * (1.0 / kSlipTime));
  const S y = whereGreater(x, one, one, x);
  return p.slip * (y * y * (3.0 - 2.0 * y));
}

/// Shift of a joint's zero and its rate.
template <class S>
struct ZeroShift {
  S by;    ///< [rad or m]
  S rate;  ///< [rad/s or m/s]
};

/// Shift drift (1 − (1 − begun) exp(−t / T)) of a cable's zero, in joint units, as caused by cables that seat
/// or warm up. t is the time since the begin of the recording [s]; before it the shift is 0.
template <class S>
CAPSTAN_CHAIN_INLINE ZeroShift<S> zeroShiftAt(const JointNumbers<S>& p, double t) {
  using std::exp;
  if (t < 0.0) return {constantLike(p.zero_drift, 0.0), constantLike(p.zero_drift, 0.0)};
  const S left = p.zero_drift * (1.0 - p.zero_drift_begun) * exp(-(p.zero_drift_rate * t));
  return {p.zero_drift - left, p.zero_drift_rate * left};
}

/// Force of one of the two cables of a pair [N]; 0 while it sags. Sets `taut` to 1, or to 0 while it sags.
template <class S>
CAPSTAN_CHAIN_INLINE S oneCable(const JointNumbers<S>& p, const S& stretch, const S& rate, S& taut) {
  const S none = constantLike(stretch, 0.0);
  const S pull = p.stiffness * (p.exponent * stretch) + p.damping * rate;
  taut = whereGreater(stretch, none, whereGreater(pull, none, constantLike(stretch, 1.0), none), none);
  return taut * pull;
}

/// Force of a cable and rates of its hidden states at one instant.
template <class S>
struct CablePull {
  S force;            ///< gamma [N]
  S damping;          ///< d gamma / d rate [N·s/m]
  S stiffness;        ///< d gamma / d stretch [N/m], without hysteresis
  S hysteresis_rate;  ///< dz/dt [m/s]
  S creep_rate;       ///< rate of the creep elongation [m/s]
};

/// Factor of the stiffness at the relative position `range` (−1…1 over the limits, kept within ±1.2):
///     (1 − (1 − w) s x) / (1 + w s x)
/// with the share s. w = 1: the free length of the cable is 1 + s x; w = 0: its stiffness is 1 − s x.
/// Numerator and denominator are at least 0.04.
template <class S>
CAPSTAN_CHAIN_INLINE S positionShare(const JointNumbers<S>& p, const S& range) {
  const S way = p.position_stiffness * clipped(range, 1.2);
  const S least = constantLike(range, 0.04);
  const S above = 1.0 - (1.0 - p.length_share) * way, below = 1.0 + p.length_share * way;
  return whereGreater(above, least, above, least) / whereGreater(below, least, below, least);
}

/// Force of spring and damper at a play, and d force / d rate.
template <class S>
struct PlayPull {
  S force, damping;
  S pressed;  ///< 1: the spring acts; 0: it does not
};

/// Force at a play of half-width h. `x` is the stretch δ beyond the play, 0 for |δ| < h. `spring` is the
/// force of the cable at x, and `rate` dδ/dt for its damper. The damper acts as p.play_damping says: 0:
/// spring and damper together press but never pull; 1: the damper acts while |δ| > h; 2: always. Values
/// between are interpolated.
template <class S>
CAPSTAN_CHAIN_INLINE PlayPull<S> playPull(const JointNumbers<S>& p, const S& x, const S& spring,
                                          const S& rate) {
  using std::abs;
  const S zero = constantLike(x, 0.0), one = constantLike(x, 1.0);
  const S damping = 2.0 * p.damping, damper = damping * rate, all = spring + damper;
  const S closed = whereGreater(abs(x), zero, one, zero);
  const S pressing =
      whereGreater(x, zero, positivePart(all), whereGreater(zero, x, -positivePart(-all), zero));
  const S pressed = whereGreater(abs(pressing), zero, one, zero);
  const S to_closed = whereGreater(p.play_damping, one, one, p.play_damping);
  const S to_always = positivePart(p.play_damping - 1.0);
  const S held = spring + closed * damper;
  PlayPull<S> pull;
  pull.force = pressing + to_closed * (held - pressing) + to_always * (all - held);
  pull.damping = damping * (pressed + to_closed * (closed - pressed) + to_always * (1.0 - closed));
  pull.pressed = pressed + to_closed * (closed - pressed);
  return pull;
}

/// Force of a cable, gamma = 2 k_e sinh(a x) + 2 b_e dδ, where x is the stretch δ minus the creep, beyond the
/// play (playPull()). Effects: stiffness that depends on the position (positionShare()), cubic stiffening
/// (Duffing), a pair of which one cable sags (it has no damper at a play), and parallel Bouc–Wen hysteresis
/// (n = 1, β = γ = 1 / 2 y).
template <class S>
CAPSTAN_CHAIN_INLINE CablePull<S> cablePull(const JointNumbers<S>& p, unsigned laws, const S& stretch,
                                            const S& rate, const S& range, const S& z, const S& creep) {
  using std::abs, std::sinh;
  CablePull<S> pull;
  S x = stretch, stiffness = 2.0 * p.stiffness, extra = constantLike(stretch, 0.0);
  if (laws & kLawCreep) {
    x = x - creep;
    pull.creep_rate = (p.creep_share * x - creep) * p.creep_rate;
  }
  if (laws & kLawHysteresis) {
    extra = extra + p.hysteresis_force * p.inverse_yield * z;
    pull.hysteresis_rate = rate - 0.5 * p.inverse_yield * (abs(rate) * z + rate * abs(z));
  }
  S hardened = constantLike(stretch, 0.0);
  if (laws & kLawStiffening) {
    hardened = 3.0 * (stiffness * p.exponent * p.stiffening * x * x);
    extra = extra + hardened * x * (1.0 / 3);
  }
  S share = constantLike(stretch, 1.0);
  if (laws & kLawPositionStiffness) share = positionShare(p, range);
  if (laws & kLawPlay) {
    const S magnitude = positivePart(abs(x) - p.play);
    x = whereGreater(x, constantLike(x, 0.0), magnitude, -magnitude);
  }
  const S y = p.exponent * x;
  const S bent = laws & kLawExponential ? sinh(y) : y + y * y * y * (1.0 / 6);
  const S spring = share * stiffness * bent;
  S force = spring + (2.0 * p.damping) * rate;
  pull.damping = 2.0 * p.damping;
  pull.stiffness = share * stiffness * p.exponent * (1.0 + 0.5 * y * y);
  if (laws & kLawPlay) {
    const S zero = constantLike(x, 0.0);
    const PlayPull<S> at_play = playPull(p, x, spring, rate);
    pull.damping = whereGreater(p.play, zero, at_play.damping, pull.damping);
    pull.stiffness = whereGreater(p.play, zero, at_play.pressed, constantLike(stretch, 1.0)) * pull.stiffness;
    force = whereGreater(p.play, zero, at_play.force, force);
  }
  if (laws & kLawSlack) {
    S one, other;
    const S pair = oneCable(p, p.pretension + x, rate, one) - oneCable(p, p.pretension - x, -rate, other);
    const S sound = constantLike(stretch, kSound);
    pull.damping = whereGreater(sound, p.pretension, share * p.damping * (one + other), pull.damping);
    pull.stiffness =
        whereGreater(sound, p.pretension, share * p.stiffness * p.exponent * (one + other), pull.stiffness);
    force = whereGreater(sound, p.pretension, share * pair, force);
  }
  pull.force = force + extra;
  pull.stiffness = pull.stiffness + hardened;
  return pull;
}

/// Friction that opposes a motion, and its derivative with respect to the speed, without negative terms.
template <class S>
struct Opposing {
  S force, slope;
};

/// Joint friction
///     F_c (1 + d asymmetry) (1 + excess e^{−(v/v_s)²}) (1 + wave) sgn v + μ |drive| sgn v
///     + F_v (1 + d asymmetry_v) v
/// with d = 1 for v > 0, else −1, and sgn v smoothed as tanh(v / v_eps): each direction has one level of
/// Coulomb friction, of which the excess and the wave are factors. `drive` is the torque of the cable or
/// motor at the joint. The slope contains the derivative of sgn v and the viscous coefficient only.
template <class S>
CAPSTAN_CHAIN_INLINE Opposing<S> jointFriction(const JointNumbers<S>& p, unsigned laws, const S& q,
                                               const S& dq, const S& drive) {
  using std::abs, std::cos, std::exp, std::sin, std::tanh;
  const S sign = tanh(dq * p.inverse_smoothing);
  const S one = constantLike(q, 1.0), direction = whereGreater(dq, constantLike(q, 0.0), one, -one);
  S force = p.coulomb;
  if (laws & kLawAsymmetry) force = force * (1.0 + p.asymmetry * direction);
  if (laws & kLawStribeck) {
    const S v = dq * p.inverse_stribeck;
    force = force * (1.0 + p.stribeck_excess * exp(-(v * v)));
  }
  if (laws & kLawWave) {
    const S phase = p.wave_number * q;
    force = force * (1.0 + p.wave_sine * sin(phase) + p.wave_cosine * cos(phase));
  }
  if (laws & kLawLoadFriction) force = force + p.load_friction * abs(drive);
  S viscous = p.viscous;
  if (laws & kLawAsymmetricViscosity) viscous = viscous * (1.0 + p.viscous_asymmetry * direction);
  return {force * sign + viscous * dq,
          positivePart(force) * p.inverse_smoothing * (1.0 - sign * sign) + viscous};
}

/// Motor friction tau_cm tanh(dq_m / v_eps) + tau_vm dq_m [N·m].
template <class S>
CAPSTAN_CHAIN_INLINE Opposing<S> motorFriction(const JointNumbers<S>& p, const S& rate) {
  using std::tanh;
  const S sign = tanh(rate * p.inverse_motor_smoothing);
  return {p.motor_coulomb * sign + p.motor_viscous * rate,
          p.motor_coulomb * p.inverse_motor_smoothing * (1.0 - sign * sign) + p.motor_viscous};
}

/// Force of the compliance of a rigid drive [N]: a linear spring with 10 % of the motor's critical damping.
template <class S>
CAPSTAN_CHAIN_INLINE S complianceForce(const JointNumbers<S>& p, const S& stretch, const S& rate) {
  using std::sqrt;
  const S k = 1.0 / p.compliance;
  return k * stretch + (0.2 / p.lever) * sqrt(k * p.motor_inertia) * rate;
}

}  // namespace capstan::robot
