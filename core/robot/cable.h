#pragma once

#include <cmath>

/// Cable and friction laws for any scalar: double, long double, automatic differentiation, SIMD packs (their
/// sinh, cosh and tanh are found by argument-dependent look-up). This file does not use Eigen, so that
/// kernels may include it.
namespace capstan::robot {

/// Cable force gamma [N], UKF paper (5)–(6):
///   gamma = k_e (exp(a delta) − exp(−a delta)) + 2 b_e d(delta)/dt
/// computed as 2 k_e sinh(a delta), which keeps full precision for a stretch near zero.
/// stiffness k_e [N], exponent a [1/m], damping b_e [N·s/m], stretch delta [m], stretch_rate [m/s].
template <class T>
inline T cableForce(double stiffness, double exponent, double damping, const T& stretch,
                    const T& stretch_rate) {
  using std::sinh;
  return (2.0 * stiffness) * sinh(exponent * stretch) + (2.0 * damping) * stretch_rate;
}

/// Cable stiffness d gamma / d delta = 2 k_e a cosh(a delta) [N/m].
template <class T>
inline T cableStiffness(double stiffness, double exponent, const T& stretch) {
  using std::cosh;
  return (2.0 * stiffness * exponent) * cosh(exponent * stretch);
}

/// Coulomb and viscous friction with smoothed sgn(v): F_c tanh(v / v_eps) + F_v v. It has the sign of v:
/// subtract it from the driving force.
template <class T>
inline T frictionForce(double coulomb, double viscous, double smoothing, const T& velocity) {
  using std::tanh;
  return coulomb * tanh(velocity / smoothing) + viscous * velocity;
}

}  // namespace capstan::robot
