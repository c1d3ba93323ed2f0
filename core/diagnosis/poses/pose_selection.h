#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// An effect that was taken, and others that would do as well in its place.
struct PoseTaken {
  PoseHypothesis effect;
  double needed = 0.0;                      ///< share of bootstrap draws in which the model is better with it
  std::vector<PoseHypothesis> competitors;  ///< not taken themselves
  std::vector<double> shares;               ///< of draws in which each competitor does better in its place
};

struct PoseSelection {
  PoseFit base;  ///< no effect
  PoseFit best;
  std::vector<PoseTaken> taken;  ///< in the order in which they came
  std::vector<Candidate> candidates;
};

/// Forward selection: each round every effect is fitted beside those taken, and the best on held-out trajectories is taken
/// if it brings enough. In the end, what later ones made superfluous is dropped, and each that was taken is
/// exchanged for each that was not. Cancelled: what there is until then.
PoseSelection selectPoses(const PoseData& data, const std::vector<PoseHypothesis>& effects,
                          std::uint64_t seed, base::Progress* progress);

}  // namespace capstan::diagnosis
