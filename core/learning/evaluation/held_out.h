#pragma once

#include <cstdint>
#include <vector>

#include "core/learning/poses/states.h"

/// Trajectories that nothing is learned from, to judge by.
namespace capstan::learning {

/// Which motions are held out: `share` of those that have states, by place among the motions.
std::vector<bool> heldOut(const std::vector<learning::State>& states, double share, std::uint64_t seed);

struct SplitStates {
  std::vector<learning::State> train, test;
};

/// The states of motions that are held out, and the others.
SplitStates splitStates(const std::vector<learning::State>& states, const std::vector<bool>& held);

}  // namespace capstan::learning
