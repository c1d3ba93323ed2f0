#pragma once

#include <array>
#include <cstddef>

/// Rigid-body dynamics of a three-joint remote-centre arm in closed form, for any scalar: double, long
/// double, automatic differentiation, SIMD packs (a pack needs + − * / with itself and products with double).
/// This file does not use Eigen, so that kernels for other instruction sets may include it.
///
/// Links 2 and 3 rotate together about the remote centre O. Frame B is the frame of link 2 before its offset
/// theta_2, so that only the sines and cosines of q1 and q2 occur. In frame B, e is the axis of joint 1, z
/// that of joint 2, u the axis of the prismatic joint, c_0 + q3 u the centre of mass of link 3 and J(q3) the
/// inertia of links 2 and 3 about O. Then
///   e = (sin(alpha_2) sin q2, sin(alpha_2) cos q2, cos(alpha_2))
///   M11 = I_1zz + e·Je    M12 = z·Je    M22 = z·Jz    M13 = m_3 e·(c_0 × u)    M23 = m_3 z·(c_0 × u)
///   M33 = m_3
/// J is quadratic in q3. With w = F sin q2 + G cos q2 and quadratics A, B, C, F, G, N of q3,
///   M11 = A + B cos 2q2 + C sin 2q2 + 2 cos(alpha_2) w    M12 = w + cos(alpha_2) N    M22 = N
///   M13 = P sin q2 + Q cos q2 + R
/// and C(q, dq) dq follows from the derivatives of M (Lagrange).
namespace capstan::robot {

/// Quadratic function value + q3 (slope + q3 bend) of q3.
struct Quadratic {
  double value = 0.0, slope = 0.0, bend = 0.0;
};

/// Constants of the closed form; armConstants() in arm_dynamics.h computes them from a robot file.
struct ArmConstants {
  double sin_alpha2 = 0.0, cos_alpha2 = 0.0;
  Quadratic a, b, c, f, g, n;        ///< quadratics A … N of the mass matrix [kg·m²]
  double p = 0.0, q = 0.0, r = 0.0;  ///< coefficients P, Q, R of M13 [kg·m]
  double m23 = 0.0, m33 = 0.0;       ///< constant entries of the mass matrix [kg·m, kg]
  double inverse_m33 = 0.0;          ///< 1 / m33 [1/kg]
  std::array<double, 3> gravity{};   ///< gravity in frame 1 at q1 = 0 [m/s²]
  std::array<double, 2> moment1{};   ///< m_1 times (x, y) of link 1's centre of mass, frame 1 [kg·m]
  std::array<double, 3> moment{};    ///< first moment of links 2 and 3 about O at q3 = 0, frame B [kg·m]
  std::array<double, 3> sliding_moment{};  ///< m_3 u, frame B [kg]
};

/// Sines and cosines of q1 and q2.
template <class T>
struct ArmTrig {
  T sin1, cos1, sin2, cos2;
};

/// Entries of M(q), and the bias C(q, dq) dq + G(q). M23 and M33 are constant: ArmConstants::m23 and m33.
template <class T>
struct ArmTerms {
  T m11, m12, m13, m22;
  std::array<T, 3> bias;
};

template <class T>
struct ValueAndSlope {
  T value, slope;
};

template <class T>
[[gnu::always_inline]] inline ValueAndSlope<T> evaluate(const Quadratic& k, const T& q3) {
  const T bend = k.bend * q3;
  const T slope = k.slope + bend;
  return {k.value + q3 * slope, slope + bend};
}

/// G(q), the negative torque of gravity [N·m, N·m, N]. It is computed in frame 1 rotated by alpha_2, where
/// the axis of joint 1 is (0, sin(alpha_2), cos(alpha_2)) and that of joint 2 is z.
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> armGravity(const ArmConstants& k, const ArmTrig<T>& trig,
                                                          const T& q3) {
  const T g1x = k.gravity[0] * trig.cos1 + k.gravity[1] * trig.sin1;
  const T g1y = k.gravity[1] * trig.cos1 - k.gravity[0] * trig.sin1;
  const T gy = k.cos_alpha2 * g1y + k.sin_alpha2 * k.gravity[2];
  const T gz = k.cos_alpha2 * k.gravity[2] - k.sin_alpha2 * g1y;

  const T ux = k.sliding_moment[0] * trig.cos2 - k.sliding_moment[1] * trig.sin2;
  const T uy = k.sliding_moment[0] * trig.sin2 + k.sliding_moment[1] * trig.cos2;
  const T sx = k.moment[0] * trig.cos2 - k.moment[1] * trig.sin2 + q3 * ux;
  const T sy = k.moment[0] * trig.sin2 + k.moment[1] * trig.cos2 + q3 * uy;
  const T sz = k.moment[2] + k.sliding_moment[2] * q3;
  const T about2 = sy * g1x - sx * gy;
  return {
      k.sin_alpha2 * (sx * gz - sz * g1x) + k.cos_alpha2 * about2 + k.moment1[1] * g1x - k.moment1[0] * g1y,
      about2, -(ux * g1x + uy * gy + k.sliding_moment[2] * gz)};
}

/// Computes mass matrix and bias at q3 [m] and dq [rad/s, rad/s, m/s].
template <class T>
[[gnu::always_inline]] inline ArmTerms<T> armTerms(const ArmConstants& k, const ArmTrig<T>& trig, const T& q3,
                                                   const std::array<T, 3>& dq) {
  const T& s = trig.sin2;
  const T& c = trig.cos2;
  const T twice_sin = (s + s) * c;  // sin 2q2
  const T twice_cos = c * c - s * s;
  const double twice_ca = 2.0 * k.cos_alpha2;
  const ValueAndSlope<T> a_ = evaluate(k.a, q3), b_ = evaluate(k.b, q3), c_ = evaluate(k.c, q3);
  const ValueAndSlope<T> f_ = evaluate(k.f, q3), g_ = evaluate(k.g, q3), n_ = evaluate(k.n, q3);

  const T w = f_.value * s + g_.value * c;
  ArmTerms<T> terms;
  terms.m11 = a_.value + b_.value * twice_cos + c_.value * twice_sin + twice_ca * w;
  terms.m12 = w + k.cos_alpha2 * n_.value;
  terms.m22 = n_.value;
  terms.m13 = k.p * s + k.q * c + k.r;

  const T m12_2 = f_.value * c - g_.value * s;  // d M12 / d q2, and so on
  const T half_m11_2 = c_.value * twice_cos - b_.value * twice_sin + k.cos_alpha2 * m12_2;
  const T m13_2 = k.p * c - k.q * s;
  const T w_3 = f_.slope * s + g_.slope * c;
  const T m11_3 = a_.slope + b_.slope * twice_cos + c_.slope * twice_sin + twice_ca * w_3;
  const T m12_3 = w_3 + k.cos_alpha2 * n_.slope;

  const std::array<T, 3> gravity = armGravity(k, trig, q3);
  const T bend = half_m11_2 * dq[0];
  const T along = m12_3 * dq[0] + n_.slope * dq[1];  // rate of the momentum about axis 2 per unit of dq3
  const T across = m11_3 * dq[0] + m12_3 * dq[1];    // the same about axis 1
  terms.bias[0] = dq[1] * (bend + bend + m12_2 * dq[1] + m13_2 * dq[2]) + dq[2] * across + gravity[0];
  terms.bias[1] = dq[2] * along - dq[0] * (bend + m13_2 * dq[2]) + gravity[1];
  terms.bias[2] = m13_2 * dq[0] * dq[1] - 0.5 * (dq[0] * across + dq[1] * along) + gravity[2];
  return terms;
}

/// Inverse dynamics without friction, tau = M ddq + C dq + G [N·m, N·m, N].
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> armInverse(const ArmConstants& k, const ArmTrig<T>& trig,
                                                          const T& q3, const std::array<T, 3>& dq,
                                                          const std::array<T, 3>& ddq) {
  const ArmTerms<T> m = armTerms(k, trig, q3, dq);
  return {m.m11 * ddq[0] + m.m12 * ddq[1] + m.m13 * ddq[2] + m.bias[0],
          m.m12 * ddq[0] + m.m22 * ddq[1] + k.m23 * ddq[2] + m.bias[1],
          m.m13 * ddq[0] + k.m23 * ddq[1] + k.m33 * ddq[2] + m.bias[2]};
}

/// Forward dynamics, ddq = M⁻¹ (tau − C dq − G) [rad/s², rad/s², m/s²]. tau is the sum of all other joint
/// torques (cables, friction with its sign, external load).
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> armForward(const ArmConstants& k, const ArmTrig<T>& trig,
                                                          const T& q3, const std::array<T, 3>& dq,
                                                          const std::array<T, 3>& tau) {
  const ArmTerms<T> m = armTerms(k, trig, q3, dq);
  const T r3 = (tau[2] - m.bias[2]) * k.inverse_m33;  // row 3 solved first: M33 is constant
  const T p = m.m13 * k.inverse_m33;
  const double q = k.m23 * k.inverse_m33;
  const T a11 = m.m11 - m.m13 * p;
  const T a12 = m.m12 - m.m13 * q;
  const T a22 = m.m22 - k.m23 * q;
  const T b1 = tau[0] - m.bias[0] - m.m13 * r3;
  const T b2 = tau[1] - m.bias[1] - k.m23 * r3;
  const T scale = 1.0 / (a11 * a22 - a12 * a12);
  const T ddq1 = (a22 * b1 - a12 * b2) * scale;
  const T ddq2 = (a11 * b2 - a12 * b1) * scale;
  return {ddq1, ddq2, r3 - p * ddq1 - q * ddq2};
}

}  // namespace capstan::robot
