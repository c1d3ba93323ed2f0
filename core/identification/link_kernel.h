#pragma once

#include "core/math/instruction_set.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// Most derivatives that the kernels carry along.
inline constexpr int kTangents = 16;

/// The link side at one instant, and its derivatives by the logarithms of the cable parameters: rows
/// q1 q2 q3 [rad, rad, m] dq1 dq2 dq3 [per second].
struct LinkTangents {
  double value[6] = {};
  alignas(64) double by_log[6][kTangents] = {};
};

/// Which tangent belongs to r_l, k_e, b_e and F_cl (row) of each joint; −1: none.
struct TangentOrder {
  int index[4][3] = {{-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}};
  int count = 0;  ///< tangents in use: 0…kTangents
};

/// Motor cable travel s_m [m] at the start of a step and its constant rate over it [m/s].
struct MotorStep {
  double travel[3], rate[3];
};

/// `steps` classical RK4 steps over dt, in place, of the process model of UKF paper (5)–(8), as
/// tracking/cable_arm_kernel.h but for the box, with forward-mode derivatives: each lane of a register is one
/// tangent, and sines, cosines, tanh and sinh are evaluated once for all of them. The derivatives are exact
/// ones of the discrete steps.
using AdvanceLink = void (*)(const tracking::CableArmConstants& c, const TangentOrder& order,
                             const MotorStep& motor, double dt, int steps, LinkTangents& x);

/// The kernel for `set`, which must be available.
AdvanceLink advanceLinkKernel(math::InstructionSet set = math::bestInstructionSet());

}  // namespace capstan::identification
