#pragma once

#include "core/math/instruction_set.h"
#include "core/robot/arm_kernel.h"

namespace capstan::tracking {

/// Lanes of one propagation: 13 sigma points and three spares.
inline constexpr int kCableArmLanes = 16;

/// What the kernels know of a robot: plain numbers, made by cableArmConstants() (cable_arm_model.h).
struct CableArmConstants {
  robot::ArmConstants body;
  double coupling[3][3];        ///< A
  double homing[3];             ///< q_hs [rad, rad, m]
  double link_radius[3];        ///< r_l [m per rad, m per m]
  double motor_scale[3];        ///< r_mc / N [m/rad]
  double stiffness[3];          ///< k_e [N]
  double exponent[3];           ///< a [1/m]
  double damping[3];            ///< b_e [N·s/m]
  double coulomb[3];            ///< F_cl [N·m, N·m, N]
  double viscous[3];            ///< F_vl
  double inverse_smoothing[3];  ///< 1 / v_eps
  double low[6], high[6];       ///< the box of believable states, q1 dq1 q2 dq2 q3 dq3
};

/// Motor position q_m [rad] and velocity dq_m [rad/s] at the start and the end of a step, linear in between.
struct CableArmDrive {
  double position0[3], velocity0[3];
  double position1[3], velocity1[3];
};

/// Cable and friction parameters that differ from lane to lane (identification): row = joint.
struct CableArmVariation {
  alignas(64) double link_radius[3][kCableArmLanes];
  alignas(64) double stiffness[3][kCableArmLanes];
  alignas(64) double damping[3][kCableArmLanes];
  alignas(64) double coulomb[3][kCableArmLanes];
};

/// Motors whose position is unknown (a failed encoder), and so the force gamma of their cables. The joint of
/// such a motor decays to rest, ddq_f = −decay_f dq_f (the random part is process noise); the unknown force
/// is the one that makes it so, and through the coupling it acts on the other joints as well. With F those
/// joints and u_j = ddq_j elsewhere, u_f = r_l gamma_f:
///     Σ_{j ∉ F} M_j u_j − Σ_{f ∈ F} (A_f)ᵀ u_f = tau − C dq − G − Σ_{f ∈ F} M_f ddq_f,
/// M_j the columns of the mass matrix, A_f the rows of the coupling, tau all other cables and friction.
struct CableArmUnknown {
  bool motor[3];
  double decay[3];  ///< [1/s]
};

/// Kernels of one instruction set. Arrays are 64-byte aligned, 16 lanes.
struct CableArmKernel {
  /// `steps` RK4 steps of dt / steps each; x is 6 × 16, rows q1 dq1 q2 dq2 q3 dq3. Points are put back into
  /// the box before and behind each step; NaN stays NaN.
  void (*propagate)(const CableArmConstants& c, const CableArmDrive& drive, double dt, int steps, double* x);
  /// The same with r_l, k_e, b_e and F_cl of each lane in place of those of `c`.
  void (*propagateVaried)(const CableArmConstants& c, const CableArmVariation& lanes,
                          const CableArmDrive& drive, double dt, int steps, double* x);
  /// `propagate` where the position of some motors, whose entries in `drive` are not looked at, is unknown.
  void (*propagateUnknown)(const CableArmConstants& c, const CableArmUnknown& unknown,
                           const CableArmDrive& drive, double dt, int steps, double* x);
  /// sin, cos, tanh and 2 sinh of 16 arguments as `propagate` computes them; sin and cos for |x| < 1e5.
  void (*elementary)(const double* x, double* sine, double* cosine, double* tangent, double* twice_sinh);
};

/// The kernel for `set`, which must be available.
const CableArmKernel& cableArmKernel(math::InstructionSet set);

}  // namespace capstan::tracking
