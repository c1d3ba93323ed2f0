#pragma once

#include "core/math/instruction_set.h"
#include "core/robot/arm_kernel.h"

namespace capstan::tracking {

/// Number of lanes of one propagation: 13 sigma points and 3 unused lanes.
inline constexpr int kCableArmLanes = 16;

/// Constants of a robot that the kernels use, as plain numbers; cableArmConstants() (cable_arm_model.h)
/// computes them.
struct CableArmConstants {
  robot::ArmConstants body;
  double coupling[3][3];        ///< coupling matrix A
  double homing[3];             ///< q_hs [rad, rad, m]
  double link_radius[3];        ///< link-side pulley radius r_l [m per rad, m per m]
  double motor_scale[3];        ///< r_mc / N [m/rad]
  double stiffness[3];          ///< k_e [N]
  double exponent[3];           ///< a [1/m]
  double damping[3];            ///< b_e [N·s/m]
  double coulomb[3];            ///< F_cl [N·m, N·m, N]
  double viscous[3];            ///< F_vl
  double inverse_smoothing[3];  ///< 1 / v_eps
  double low[6], high[6];       ///< bounds of plausible states, q1 dq1 q2 dq2 q3 dq3
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

/// Motors whose position, and therefore whose cable force gamma, is unknown (failed encoder). The joint of
/// such a motor decays to rest, ddq_f = −decay_f dq_f (the random part is process noise). The unknown force
/// is solved from this acceleration; through the coupling it also acts on the other joints. F is the set of
/// these joints; the unknowns are u_f = r_l gamma_f in F and u_j = ddq_j elsewhere:
///     Σ_{j ∉ F} M_j u_j − Σ_{f ∈ F} (A_f)ᵀ u_f = tau − C dq − G − Σ_{f ∈ F} M_f ddq_f,
/// where M_j are columns of the mass matrix, A_f rows of the coupling, and tau is all other cable forces and
/// friction.
struct CableArmUnknown {
  bool motor[3];
  double decay[3];  ///< [1/s]
};

/// Kernels of one instruction set. Arrays are 64-byte aligned and have 16 lanes.
struct CableArmKernel {
  /// Advances x by `steps` RK4 steps of dt / steps each; x is 6 × 16, rows q1 dq1 q2 dq2 q3 dq3. Points are
  /// clamped to [low, high] before and after each step; NaN stays NaN.
  void (*propagate)(const CableArmConstants& c, const CableArmDrive& drive, double dt, int steps, double* x);
  /// Like propagate(), with r_l, k_e, b_e and F_cl of each lane in place of those of `c`.
  void (*propagateVaried)(const CableArmConstants& c, const CableArmVariation& lanes,
                          const CableArmDrive& drive, double dt, int steps, double* x);
  /// Like propagate(), for motors of which some have an unknown position; their entries in `drive` are
  /// ignored.
  void (*propagateUnknown)(const CableArmConstants& c, const CableArmUnknown& unknown,
                           const CableArmDrive& drive, double dt, int steps, double* x);
  /// Computes sin, cos, tanh and 2 sinh of 16 arguments as propagate() does; sin and cos for |x| < 1e5.
  void (*elementary)(const double* x, double* sine, double* cosine, double* tangent, double* twice_sinh);
};

/// Kernel for the instruction set `set`, which must be available.
const CableArmKernel& cableArmKernel(math::InstructionSet set);

}  // namespace capstan::tracking
