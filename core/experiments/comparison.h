#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"
#include "core/experiments/published.h"
#include "core/experiments/results.h"

namespace capstan::experiments {

enum class Verdict {
  kMet,
  kSaid,  ///< not met, but the result reports it: σ above the goal, an advice, the truth in the 95 % interval
  kMissed  ///< not met
};

/// One goal of a reproduction of the UKF paper, and the result.
struct Goal {
  std::string what;      ///< "k_e2 within 5 % of the truth"
  std::string measured;  ///< "+1.3 %"
  Verdict verdict = Verdict::kMissed;
};

/// Returns the goals that `results` decide. Only results that are isPapers() count, in any order.
///   A   pulley radius of joint 1 within 0.3 % of the truth
///   B   each k_e within 5 %, each b_e within 15 %, or reported as not observable
///   C   mean kinematic errors within 15 % of the paper's; improvement over transmission kinematics larger
///       than the paper's on each joint
///   D   RMS of each joint with the most occlusion at most 1.10 times that with the least
std::vector<Goal> goalsOf(const std::vector<Results>& results, const Published& published);
base::Table goalTable(const std::vector<Goal>& goals);

/// Returns a Markdown page with goals, all tables, seeds or recordings, times and version. Experiments of the
/// paper have the paper's numbers beside the results. The first sentence says whether the robot is simulated.
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
