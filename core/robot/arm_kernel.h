#pragma once

#include <array>
#include <cstddef>

/// Rigid-body dynamics of a three-joint remote-centre arm in closed form, for any scalar: double, long
/// double, automatic differentiation, SIMD packs (a pack needs + − * / with itself and products with double).
/// No Eigen here, so that kernels compiled for other instruction sets may include it.
///
/// Links 2 and 3 turn together about the remote centre O; frame B is link 2's frame before its offset
/// theta_2, so that sines and cosines are those of q1 and q2 themselves. In B, with e the axis of joint 1, z
/// that of joint 2, u the axis of the prismatic joint and c(q3) = c_0 + q3 u the centre of mass of link 3:
///   omega = e dq1 + z dq2,   e = (sin(alpha_2) sin q2, sin(alpha_2) cos q2, cos(alpha_2))
///   J(q3) = J_0 + q3 J_1 + q3² J_2     inertia of links 2 and 3 about O
///   H     = J omega + m_3 (c × u) dq3  angular momentum about O
///   tau_1 = I_1zz ddq1 + e · dH/dt,  tau_2 = z · dH/dt,  tau_3 = m_3 u · acceleration of c,  each less
///   gravity's.
namespace capstan::robot {

/// Symmetric 3×3: xx, xy, xz, yy, yz, zz.
using Symmetric = std::array<double, 6>;

/// What the closed form needs of a robot file; made by armConstants() in arm_dynamics.h. Frame B where not
/// said.
struct ArmConstants {
  double sin_alpha2 = 0.0, cos_alpha2 = 0.0;
  std::array<double, 3> gravity{};          ///< in frame 1 at q1 = 0 [m/s²]
  double inertia1 = 0.0;                    ///< of link 1 about axis 1 [kg·m²]
  std::array<double, 2> moment1{};          ///< m_1 (x, y) of link 1's centre of mass, frame 1 [kg·m]
  Symmetric j0{}, j1{}, j2{};               ///< J(q3) [kg·m², kg·m, kg]
  std::array<double, 3> moment{};           ///< first moment of links 2 and 3 about O at q3 = 0 [kg·m]
  std::array<double, 3> sliding_moment{};   ///< m_3 u [kg]
  std::array<double, 3> cross{};            ///< m_3 c_0 × u [kg·m]
  double mass3 = 0.0, inverse_mass3 = 0.0;  ///< [kg], [1/kg]
};

/// Sines and cosines of q1 and q2.
template <class T>
struct ArmTrig {
  T sin1, cos1, sin2, cos2;
};

/// M(q) and C(q, dq) dq + G(q). M23 and M33 are constant: ArmConstants::cross[2] and mass3.
template <class T>
struct ArmTerms {
  T m11, m12, m13, m22;
  std::array<T, 3> bias;
};

template <class T>
[[gnu::always_inline]] inline std::array<T, 3> multiply(const std::array<T, 6>& s,
                                                        const std::array<T, 3>& v) {
  return {s[0] * v[0] + s[1] * v[1] + s[2] * v[2], s[1] * v[0] + s[3] * v[1] + s[4] * v[2],
          s[2] * v[0] + s[4] * v[1] + s[5] * v[2]};
}

/// Mass matrix and bias at q3 [m] and dq [rad/s, rad/s, m/s].
template <class T>
[[gnu::always_inline]] inline ArmTerms<T> armTerms(const ArmConstants& k, const ArmTrig<T>& trig, const T& q3,
                                                   const std::array<T, 3>& dq) {
  const T ex = k.sin_alpha2 * trig.sin2;
  const T ey = k.sin_alpha2 * trig.cos2;
  const double ez = k.cos_alpha2;

  std::array<T, 6> inertia;  // J
  std::array<T, 6> slope;    // dJ / dq3
  for (std::size_t i = 0; i < 6; ++i) {
    const T square = k.j2[i] * q3;
    inertia[i] = k.j0[i] + q3 * (k.j1[i] + square);
    slope[i] = k.j1[i] + (square + square);
  }

  const std::array<T, 3> je = {inertia[0] * ex + inertia[1] * ey + inertia[2] * ez,
                               inertia[1] * ex + inertia[3] * ey + inertia[4] * ez,
                               inertia[2] * ex + inertia[4] * ey + inertia[5] * ez};
  ArmTerms<T> terms;
  terms.m11 = k.inertia1 + (ex * je[0] + ey * je[1] + ez * je[2]);
  terms.m12 = je[2];
  terms.m22 = inertia[5];
  terms.m13 = k.cross[0] * ex + k.cross[1] * ey + k.cross[2] * ez;

  const std::array<T, 3> omega = {ex * dq[0], ey * dq[0], ez * dq[0] + dq[1]};
  const std::array<T, 3> momentum = {je[0] * dq[0] + inertia[2] * dq[1] + k.cross[0] * dq[2],
                                     je[1] * dq[0] + inertia[4] * dq[1] + k.cross[1] * dq[2],
                                     je[2] * dq[0] + inertia[5] * dq[1] + k.cross[2] * dq[2]};
  const std::array<T, 3> slope_omega = multiply(slope, omega);
  const T dx = omega[1] * dq[1];  // de/dt dq1 = (e × z) dq1 dq2 = (dx, −dy, 0)
  const T dy = omega[0] * dq[1];

  const T g1x = k.gravity[0] * trig.cos1 + k.gravity[1] * trig.sin1;
  const T g1y = k.gravity[1] * trig.cos1 - k.gravity[0] * trig.sin1;
  const T side = k.cos_alpha2 * g1y + k.sin_alpha2 * k.gravity[2];
  const std::array<T, 3> g = {g1x * trig.cos2 + side * trig.sin2, side * trig.cos2 - g1x * trig.sin2,
                              k.cos_alpha2 * k.gravity[2] - k.sin_alpha2 * g1y};
  const std::array<T, 3> s = {k.moment[0] + k.sliding_moment[0] * q3, k.moment[1] + k.sliding_moment[1] * q3,
                              k.moment[2] + k.sliding_moment[2] * q3};

  const T nx = inertia[0] * dx - inertia[1] * dy + dq[2] * slope_omega[0] +
               (omega[1] * momentum[2] - omega[2] * momentum[1]) - (s[1] * g[2] - s[2] * g[1]);
  const T ny = inertia[1] * dx - inertia[3] * dy + dq[2] * slope_omega[1] +
               (omega[2] * momentum[0] - omega[0] * momentum[2]) - (s[2] * g[0] - s[0] * g[2]);
  const T nz = inertia[2] * dx - inertia[4] * dy + dq[2] * slope_omega[2] +
               (omega[0] * momentum[1] - omega[1] * momentum[0]) - (s[0] * g[1] - s[1] * g[0]);
  const T centrifugal =
      0.5 * (omega[0] * slope_omega[0] + omega[1] * slope_omega[1] + omega[2] * slope_omega[2]);

  terms.bias[0] = ex * nx + ey * ny + ez * nz - (k.moment1[0] * g1y - k.moment1[1] * g1x);
  terms.bias[1] = nz;
  terms.bias[2] = k.cross[0] * dx - k.cross[1] * dy - centrifugal -
                  (k.sliding_moment[0] * g[0] + k.sliding_moment[1] * g[1] + k.sliding_moment[2] * g[2]);
  return terms;
}

/// Inverse dynamics without friction, tau = M ddq + C dq + G [N·m, N·m, N].
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> armInverse(const ArmConstants& k, const ArmTrig<T>& trig,
                                                          const T& q3, const std::array<T, 3>& dq,
                                                          const std::array<T, 3>& ddq) {
  const ArmTerms<T> m = armTerms(k, trig, q3, dq);
  return {m.m11 * ddq[0] + m.m12 * ddq[1] + m.m13 * ddq[2] + m.bias[0],
          m.m12 * ddq[0] + m.m22 * ddq[1] + k.cross[2] * ddq[2] + m.bias[1],
          m.m13 * ddq[0] + k.cross[2] * ddq[1] + k.mass3 * ddq[2] + m.bias[2]};
}

/// Forward dynamics, ddq = M⁻¹ (tau − C dq − G) [rad/s², rad/s², m/s²]; tau holds everything else that acts
/// on the joints (cables, friction with its sign, external load).
template <class T>
[[gnu::always_inline]] inline std::array<T, 3> armForward(const ArmConstants& k, const ArmTrig<T>& trig,
                                                          const T& q3, const std::array<T, 3>& dq,
                                                          const std::array<T, 3>& tau) {
  const ArmTerms<T> m = armTerms(k, trig, q3, dq);
  const T r3 = (tau[2] - m.bias[2]) * k.inverse_mass3;  // row 3 solved first: M33 is constant
  const T p = m.m13 * k.inverse_mass3;
  const double q = k.cross[2] * k.inverse_mass3;
  const T a11 = m.m11 - m.m13 * p;
  const T a12 = m.m12 - m.m13 * q;
  const T a22 = m.m22 - k.cross[2] * q;
  const T b1 = tau[0] - m.bias[0] - m.m13 * r3;
  const T b2 = tau[1] - m.bias[1] - k.cross[2] * r3;
  const T scale = 1.0 / (a11 * a22 - a12 * a12);
  const T ddq1 = (a22 * b1 - a12 * b2) * scale;
  const T ddq2 = (a11 * b2 - a12 * b1) * scale;
  return {ddq1, ddq2, r3 - p * ddq1 - q * ddq2};
}

}  // namespace capstan::robot
