#pragma once

#include <cstdint>
#include <vector>

#include "core/learning/poses/states.h"

/// Hold-out set of trajectories for evaluation.
namespace capstan::learning {

/// Selects the motions to hold out: `share` of those that have states. The result is indexed by motion; true:
/// held out.
std::vector<bool> heldOut(const std::vector<learning::State>& states, double share, std::uint64_t seed);

struct SplitStates {
  std::vector<learning::State> train, test;
};

/// Splits states into those of motions held out (test) and the others (train).
SplitStates splitStates(const std::vector<learning::State>& states, const std::vector<bool>& held);

}  // namespace capstan::learning
