#pragma once

#include "core/learning/correction_model.h"

namespace capstan::learning {

/// A pose to visit next.
struct NextPose {
  std::size_t candidate = 0;  ///< place among the candidates
  double before = 0.0;        ///< mean of 1 − confidence over all candidates before this visit
  double after = 0.0;         ///< and what it will be
};

/// Which of `candidates` to visit so that the model becomes surer of all of them, one after the other: of
/// those whose variance is largest the one that lowers the mean of all most. The variance of a Gaussian
/// process does not depend on what will be seen, so that each visit's effect is known beforehand (Krause,
/// Singh and Guestrin, Near-optimal sensor placements in Gaussian processes, JMLR 9 (2008): greedy choice).
/// Fewer than `count` where no visit helps.
std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress = nullptr);

/// Poses over all that a model has learned, at rest, to choose from: a grid of `each` positions along each
/// axis of its workspace, each in the middle of its turns and turned to both ends about each axis.
std::vector<State> posesWithin(const CorrectionModel& model, int each);

}  // namespace capstan::learning
