#pragma once

#include <cstddef>

#include "core/math/instruction_set.h"
#include "core/robot/chain/chain_numbers.h"

namespace capstan::robot {

/// Robots that are simulated side by side.
inline constexpr int kChainLanes = 16;
struct alignas(64) ChainLane {
  double value[kChainLanes];
};

/// Rows of a recording as the kernels read them: joint j's row k at column[j][k].
struct ChainRows {
  const double* t = nullptr;                     ///< [s]
  const double* drive[kChainJoints] = {};        ///< q_m [rad], or torque of rigid drives
  const double* load[kChainJoints] = {};         ///< tau_ext; null: none
  const double* signed_load[kChainJoints] = {};  ///< null: as `load`
};

/// A segment of rows to simulate, begin to end, and the place of every `stride`-th row of it, the first one
/// included: q and dq of joint j at output k in q[(k n + j) kChainLanes + lane], both 64-byte aligned.
struct ChainRun {
  std::size_t begin = 0, end = 0;
  int steps = 1;  ///< a row
  int stride = 1;
  double* q = nullptr;
  double* dq = nullptr;
};

/// Advances the 16 robots of `numbers` from `state` at row run.begin to row run.end − 1, in place.
using SimulateChain = void (*)(const ChainShape& shape, const ChainNumbers<ChainLane>& numbers,
                               const ChainRows& rows, const ChainRun& run, ChainState<ChainLane>& state);

/// The kernel for `set`, which must be available.
SimulateChain simulateChainKernel(math::InstructionSet set = math::bestInstructionSet());

}  // namespace capstan::robot
