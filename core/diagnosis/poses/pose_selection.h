#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Selected effect, and the effects that explain the data about as well in its place.
struct PoseTaken {
  PoseHypothesis effect;
  double needed = 0.0;  ///< share of bootstrap draws in which the model with the effect is better
  std::vector<PoseHypothesis> competitors;  ///< effects that were not selected
  std::vector<double> shares;  ///< per competitor: share of draws in which it is better in the effect's place
};

/// Result of selectPoses().
struct PoseSelection {
  PoseFit base;  ///< fit without effects
  PoseFit best;  ///< fit with all selected effects
  std::vector<PoseTaken> taken;  ///< selected effects, in the order of their selection
  std::vector<Candidate> candidates;
};

/// Forward selection. In each round every remaining effect is fitted together with the selected ones, and the
/// effect with the smallest held-out error is selected if it reduces this error materially. At the end,
/// effects that later ones have made superfluous are removed, and each selected effect is exchanged for each
/// of the others to find competitors. If `progress` is cancelled, the result contains what was selected until
/// then.
PoseSelection selectPoses(const PoseData& data, const std::vector<PoseHypothesis>& effects,
                          std::uint64_t seed, base::Progress* progress);

}  // namespace capstan::diagnosis
