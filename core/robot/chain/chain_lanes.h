#pragma once

#include <cstddef>

#include "core/math/instruction_set.h"
#include "core/robot/chain/chain_numbers.h"

namespace capstan::robot {

/// Number of robots that are simulated in parallel.
inline constexpr int kChainLanes = 16;
struct alignas(64) ChainLane {
  double value[kChainLanes];
};

/// Rows of a recording in the kernels' layout: row k of joint j is at [j][k].
struct ChainRows {
  const double* t = nullptr;                     ///< times [s]
  const double* drive[kChainJoints] = {};        ///< q_m [rad], or torque of rigid drives [N·m]
  const double* load[kChainJoints] = {};         ///< tau_ext [N·m or N]; null when there is no load
  const double* signed_load[kChainJoints] = {};  ///< tau_ext with sign [N·m or N]; null when equal to `load`
};

/// Segment of rows [begin, end) to simulate, and memory for the output of every `stride`-th row from the
/// first on. Output k of joint j of n is at q[(k n + j) kChainLanes + lane] and likewise in dq; both are
/// 64-byte aligned.
struct ChainRun {
  std::size_t begin = 0, end = 0;
  int steps = 1;  ///< number of integration steps per row
  int stride = 1;
  double* q = nullptr;
  double* dq = nullptr;
};

/// Advances the 16 robots of `numbers` in place, from `state` at row run.begin to row run.end − 1.
using SimulateChain = void (*)(const ChainShape& shape, const ChainNumbers<ChainLane>& numbers,
                               const ChainRows& rows, const ChainRun& run, ChainState<ChainLane>& state);

/// Kernel for the instruction set `set`, which must be available.
SimulateChain simulateChainKernel(math::InstructionSet set = math::bestInstructionSet());

}  // namespace capstan::robot
