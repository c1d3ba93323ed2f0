#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"
#include "core/experiments/published.h"
#include "core/experiments/results.h"

namespace capstan::experiments {

/// One thing that a reproduction of the UKF paper should reach, and what it did.
struct Goal {
  std::string what;      ///< "k_e2 within 5 % of the truth"
  std::string measured;  ///< "+1.3 %"
  bool met = false;
};

/// The goals that `results` (of A, B, C, D, in any order; others are passed over) can tell:
///   A   joint 1's pulley radius within 0.3 % of the truth
///   B   each k_e within 5 %, each b_e within 15 %, or said to be out of sight
///   C   mean kinematic errors within 15 % of the paper's; improvement over transmission kinematics better
///   than
///       the paper's on each joint
///   D   RMS of each joint with the most occlusion at most 1.10 times that with the least
std::vector<Goal> goalsOf(const std::vector<Results>& results, const Published& published);
base::Table goalTable(const std::vector<Goal>& goals);

/// One page, Markdown: goals, then every table with the paper's numbers beside ours, seeds, times and
/// version. Says in its first sentence whether the robot is simulated.
std::string comparisonPage(const std::vector<Results>& results, const Published& published);

}  // namespace capstan::experiments
