#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::test::law {

/// Cable travel of a capstan whose axis is off its centre by e [m], minus that of a centred one; 0 at angle
/// 0. It is the integral of e cos(angle + phase), the deviation of the effective radius, over the angle.
inline double eccentricTravel(double e, double angle, double phase) {
  return e * (std::sin(angle + phase) - std::sin(phase));
}

/// Drift of a zero t [s] after it was set; it tends to `all`. A body that warms up follows its surroundings
/// exponentially (Newton's law of cooling), and its length follows its temperature.
inline double settledZero(double all, double t, double time_constant) {
  return t > 0.0 ? -all * std::expm1(-t / time_constant) : 0.0;
}
/// Derivative of settledZero() by t.
inline double settlingZero(double all, double t, double time_constant) {
  return t > 0.0 ? all / time_constant * std::exp(-t / time_constant) : 0.0;
}

/// Elongation beyond a play of half-width h [m] (Nordin, Gutman: Controlling mechanical systems with
/// backlash, Automatica 38, 2002, eq. 4, dead zone).
inline double deadZone(double stretch, double h) {
  return stretch > h ? stretch - h : stretch < -h ? stretch + h : 0.0;
}

/// Force of a spring and damper behind a play, which can press but not pull: it never has the opposite sign
/// of the elongation.
inline double pressing(double force, double elongation) {
  return elongation > 0.0 ? std::max(force, 0.0) : elongation < 0.0 ? std::min(force, 0.0) : 0.0;
}

/// Force of one of the two cables of a joint: k (e^{a x} − 1) + b dx/dt while the cable is taut (x > 0),
/// never below 0, and 0 while it sags.
inline double oneCable(double k, double a, double b, double x, double dx) {
  return x > 0.0 ? std::max(k * std::expm1(a * x) + b * dx, 0.0) : 0.0;
}

/// Force of an antagonistic pair with a pretension stretch x0 [m] (negative: both cables are too long
/// by −x0). For |stretch| < x0 the force is k e^{a x0} (e^{a x} − e^{−a x}) + 2 b dx/dt; beyond, one cable
/// sags and the stiffness is halved.
inline double cablePair(double k, double a, double b, double x0, double stretch, double rate) {
  return oneCable(k, a, b, x0 + stretch, rate) - oneCable(k, a, b, x0 - stretch, -rate);
}

/// Stiffness relative to that in the middle of the range, for a cable whose free length L grows over the
/// joint's range (stiffness E A / L). At ±1 of the range the length is 1 ± m times that in the middle.
inline double freeLengthShare(double m, double range) {
  return 1.0 / (1.0 + m * std::clamp(range, -1.2, 1.2));
}

/// Rate dz/dt of the Bouc–Wen law with n = 1, A = 1, beta = gamma = 1/(2 y): dx − (|dx| z + dx |z|)/(2 y).
/// |z| stays below the yield stretch y [m] (Wen, J. Eng. Mech. Div. ASCE 102, 1976).
inline double boucWenRate(double z, double dx, double yield) {
  return dx - (std::abs(dx) * z + dx * std::abs(z)) / (2.0 * yield);
}

/// Rate dx_c/dt of a Kelvin–Voigt element in series with the cable (standard linear solid; Findley, Lai,
/// Onaran: Creep and Relaxation, 1976, 5.5). Its elongation x_c follows share × elastic stretch with the time
/// constant.
inline double creepRate(double x_c, double elastic_stretch, double share, double time_constant) {
  return (share * elastic_stretch - x_c) / time_constant;
}

/// Stribeck friction over Coulomb friction: (F_s − F_c)/F_c exp(−(v/v_s)²) (Armstrong-Hélouvry, Dupont,
/// Canudas de Wit, Automatica 30, 1994, eq. 3).
inline double stribeckShare(double excess, double v, double v_s) {
  const double x = v / v_s;
  return excess * std::exp(-x * x);
}

/// Relative variation of Coulomb friction along a guide that is tighter at some positions: a sine of
/// position.
inline double positionShare(double m, double q, double period, double phase) {
  return m * std::sin(2.0 * std::numbers::pi * q / period + phase);
}

/// Disturbance that is not measured: a machine beside the robot vibrates at f [Hz].
inline double vibration(double amplitude, double f, double t, double phase) {
  return amplitude * std::sin(2.0 * std::numbers::pi * f * t + phase);
}

/// Force of hoses and wires towards the middle of the joint's range: −c x³ with x = −1…1 over the range.
inline double hardeningSpring(double c, double range) { return -c * range * range * range; }

/// Force of a magnetic detent with positions `period` [rad or m] apart: conservative and sinusoidal.
inline double detent(double amplitude, double q, double period, double phase) {
  return amplitude * std::sin(2.0 * std::numbers::pi * q / period + phase);
}

}  // namespace capstan::test::law
