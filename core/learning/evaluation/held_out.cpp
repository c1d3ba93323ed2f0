#include "core/learning/evaluation/held_out.h"

#include <cmath>

#include "core/learning/gaussian_process/sparse_process.h"

namespace capstan::learning {

using learning::State;

std::vector<bool> heldOut(const std::vector<State>& states, double share, std::uint64_t seed) {
  std::vector<std::size_t> motions;
  for (const State& state : states)
    if (motions.empty() || motions.back() != state.motion) motions.push_back(state.motion);
  std::vector<bool> held(states.empty() ? 0 : states.back().motion + 1, false);
  const auto count = static_cast<Eigen::Index>(std::lround(share * static_cast<double>(motions.size())));
  for (const Eigen::Index k : learning::drawnPoints(static_cast<Eigen::Index>(motions.size()), count, seed))
    held[motions[static_cast<std::size_t>(k)]] = true;
  return held;
}

SplitStates splitStates(const std::vector<State>& states, const std::vector<bool>& held) {
  SplitStates split;
  for (const State& state : states) (held[state.motion] ? split.test : split.train).push_back(state);
  return split;
}

}  // namespace capstan::learning
