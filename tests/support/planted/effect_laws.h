#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::test::law {

/// Cable paid out by a capstan whose axis is off its centre by e [m] beyond that of a round one, from where
/// it stood at angle 0: the effective radius is r + e cos(angle + phase); its integral over the angle.
inline double eccentricTravel(double e, double angle, double phase) {
  return e * (std::sin(angle + phase) - std::sin(phase));
}

/// How far a zero has moved t [s] after it was set, `all` of it in the end: a body that warms up follows its
/// surroundings exponentially (Newton's law of cooling), and what it carries follows its length.
inline double settledZero(double all, double t, double time_constant) {
  return t > 0.0 ? -all * std::expm1(-t / time_constant) : 0.0;
}
/// Its derivative.
inline double settlingZero(double all, double t, double time_constant) {
  return t > 0.0 ? all / time_constant * std::exp(-t / time_constant) : 0.0;
}

/// Elongation beyond a play of half-width h [m] (Nordin, Gutman: Controlling mechanical systems with
/// backlash, Automatica 38, 2002, eq. 4, dead zone).
inline double deadZone(double stretch, double h) {
  return stretch > h ? stretch - h : stretch < -h ? stretch + h : 0.0;
}

/// Spring and damper behind a play press, they do not pull: the force keeps the sign of the elongation.
inline double pressing(double force, double elongation) {
  return elongation > 0.0 ? std::max(force, 0.0) : elongation < 0.0 ? std::min(force, 0.0) : 0.0;
}

/// One of the two cables of a joint: k (e^{a x} − 1) + b dx/dt while it is taut (x > 0), nothing while it
/// sags.
inline double oneCable(double k, double a, double b, double x, double dx) {
  return x > 0.0 ? std::max(k * std::expm1(a * x) + b * dx, 0.0) : 0.0;
}

/// Force of an antagonistic pair with a pretension stretch x0 [m] (negative: both too long by it). With
/// |stretch| < x0 the pair is k e^{a x0} (e^{a x} − e^{−a x}) + 2 b dx/dt; beyond it one cable sags and half
/// the stiffness is gone.
inline double cablePair(double k, double a, double b, double x0, double stretch, double rate) {
  return oneCable(k, a, b, x0 + stretch, rate) - oneCable(k, a, b, x0 - stretch, -rate);
}

/// Share of the stiffness with a cable whose free length grows from one end of the joint's range to the other
/// (stiffness E A / L): at ±1 of the range the length is 1 ± m of that in the middle.
inline double freeLengthShare(double m, double range) {
  return 1.0 / (1.0 + m * std::clamp(range, -1.2, 1.2));
}

/// Bouc–Wen with n = 1, A = 1, beta = gamma = 1/(2 y): dz/dt = dx − (|dx| z + dx |z|)/(2 y); |z| ends at the
/// yield stretch y [m] (Wen, J. Eng. Mech. Div. ASCE 102, 1976).
inline double boucWenRate(double z, double dx, double yield) {
  return dx - (std::abs(dx) * z + dx * std::abs(z)) / (2.0 * yield);
}

/// Kelvin–Voigt element in series with the cable (standard linear solid; Findley, Lai, Onaran: Creep and
/// Relaxation, 1976, 5.5): its elongation x_c follows `share` of the elastic stretch with time constant T.
inline double creepRate(double x_c, double elastic_stretch, double share, double time_constant) {
  return (share * elastic_stretch - x_c) / time_constant;
}

/// (F_s − F_c)/F_c exp(−(v/v_s)²) (Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30, 1994, eq. 3).
inline double stribeckShare(double excess, double v, double v_s) {
  const double x = v / v_s;
  return excess * std::exp(-x * x);
}

/// Coulomb friction along a guide that is tighter in places: a wave over the joint's range.
inline double positionShare(double m, double q, double period, double phase) {
  return m * std::sin(2.0 * std::numbers::pi * q / period + phase);
}

/// A disturbance nobody measures: a machine beside the robot shakes at f [Hz].
inline double vibration(double amplitude, double f, double t, double phase) {
  return amplitude * std::sin(2.0 * std::numbers::pi * f * t + phase);
}

/// Hoses and wires that hold the joint near the middle of its range: −c x³ at x = −1…1 of the range.
inline double hardeningSpring(double c, double range) { return -c * range * range * range; }

/// Cogging of a magnetic detent, `period` [rad or m] apart: conservative, sinusoidal.
inline double detent(double amplitude, double q, double period, double phase) {
  return amplitude * std::sin(2.0 * std::numbers::pi * q / period + phase);
}

}  // namespace capstan::test::law
