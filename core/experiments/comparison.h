#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"
#include "core/experiments/published.h"
#include "core/experiments/results.h"

namespace capstan::experiments {

enum class Verdict {
  kMet,
  kSaid,   ///< not met, and the result states it itself: σ beyond the goal, in words, the truth in its 95 %
           ///< interval
  kMissed  ///< not met
};

/// One thing that a reproduction of the UKF paper should reach, and what it did.
struct Goal {
  std::string what;      ///< "k_e2 within 5 % of the truth"
  std::string measured;  ///< "+1.3 %"
  Verdict verdict = Verdict::kMissed;
};

/// The goals that `results` (those that are isPapers(), in any order; others are ignored) determine:
///   A   joint 1's pulley radius within 0.3 % of the truth
///   B   each k_e within 5 %, each b_e within 15 %, or said to be not observable
///   C   mean kinematic errors within 15 % of the paper's; improvement over transmission kinematics better
///   than
///       the paper's on each joint
///   D   RMS of each joint with the most occlusion at most 1.10 times that with the least
std::vector<Goal> goalsOf(const std::vector<Results>& results, const Published& published);
base::Table goalTable(const std::vector<Goal>& goals);

/// One page, Markdown: goals, then every table, seeds or recordings, times and version; of the paper's
/// experiments with the paper's numbers beside ours. Says in its first sentence whether the robot is
/// simulated.
std::string comparisonPage(const std::vector<Results>& results, const Published& published);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::Verdict> {
  using E = capstan::experiments::Verdict;
  static constexpr std::array value = {std::pair{E::kMet, "met"}, std::pair{E::kSaid, "not met, reported"},
                                       std::pair{E::kMissed, "not met"}};
};

template <>
struct capstan::base::KeysOf<capstan::experiments::Verdict> {
  using E = capstan::experiments::Verdict;
  static constexpr std::array value = {std::pair{E::kMet, "met"}, std::pair{E::kSaid, "not_observable"},
                                       std::pair{E::kMissed, "not_met"}};
};
