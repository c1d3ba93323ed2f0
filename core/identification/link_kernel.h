#pragma once

#include "core/math/instruction_set.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// Largest number of derivatives in the kernels.
inline constexpr int kTangents = 16;

/// State of the link side and its derivatives by the logarithms of the cable parameters: rows q1 q2 q3 [rad,
/// rad, m], dq1 dq2 dq3 [per second].
struct LinkTangents {
  double value[6] = {};
  alignas(64) double by_log[6][kTangents] = {};
};

/// Index of the tangent of r_l, k_e, b_e and F_cl (rows) of each joint (columns); −1: none.
struct TangentOrder {
  int index[4][3] = {{-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}};
  int count = 0;  ///< number of tangents in use: 0…kTangents
};

/// Motor cable travel s_m [m] at the start of a step and its constant rate over it [m/s].
struct MotorStep {
  double travel[3], rate[3];
};

/// Advances `x` in place by `steps` classical RK4 steps over `dt` [s] of the process model of UKF paper
/// (5)–(8), with forward-mode derivatives. The model is that of tracking/cable_arm_kernel.h, but states are
/// not clamped. Each lane of a register is one tangent; sines, cosines, tanh and sinh are evaluated once for
/// all. The derivatives are exact for the discrete steps.
using AdvanceLink = void (*)(const tracking::CableArmConstants& c, const TangentOrder& order,
                             const MotorStep& motor, double dt, int steps, LinkTangents& x);

/// Kernel for the instruction set `set`, which this processor must have.
AdvanceLink advanceLinkKernel(math::InstructionSet set = math::bestInstructionSet());

}  // namespace capstan::identification
