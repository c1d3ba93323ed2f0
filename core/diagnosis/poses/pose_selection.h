#pragma once

#include <compare>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/posterior.h"

namespace capstan::diagnosis {

/// Pose hypothesis as a candidate for the model. `hypothesis` points into the list given to selectPoses().
struct PoseEffect {
  const PoseHypothesis* hypothesis = nullptr;
  static constexpr int joint = 0;  ///< whole arm

  std::string_view name() const { return hypothesis->name; }
  friend auto operator<=>(const PoseEffect&, const PoseEffect&) = default;
};

/// Result of selectPoses().
struct PoseSelection {
  PoseFit base;                                        ///< fit without effects
  PoseFit best;                                        ///< fit with the selected effects
  PoseFit most_probable;                               ///< with those of the most probable set
  BlockSquares base_squares, best_squares;             ///< held-out residuals of the two
  std::vector<SelectedOf<PoseEffect>> effects;         ///< effects with the largest loss first
  std::vector<UncertainOf<PoseEffect>> uncertain;      ///< not selected (kMinOddsWithout)
  std::vector<CompetitorsOf<PoseEffect>> competitors;  ///< effects with competitors, in the same order
  std::vector<SetProbability> posterior;
  std::vector<Candidate> candidates;
};

/// Searches sets of effects and selects one of them (posterior.h). The search fits all sets that differ by
/// one effect, or by the exchange of one for another, from a set within kOccam of the best one. If `progress`
/// is cancelled, the result contains what was fitted until then.
PoseSelection selectPoses(const PoseData& data, const std::vector<PoseHypothesis>& effects,
                          std::uint64_t seed, base::Progress* progress);
inline constexpr double kProgressOfSearch = 0.8;  ///< value of `progress` at the end

}  // namespace capstan::diagnosis
