#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// A pose to visit next.
struct NextPose {
  std::size_t candidate = 0;  ///< place among the candidates
  double before = 0.0;        ///< uncertainty over all candidates before this visit
  double after = 0.0;         ///< and what it will be
};

/// Which of `candidates` to visit so that the model becomes surer of all of them, one after the other, each
/// once: that which lowers the uncertainty most, the mean over the candidates of the correction's variance
/// over its variance without data (all outputs together, turns by the lever). The variance of a Gaussian
/// process does not depend on what will be seen, so that each visit's effect is known beforehand: with the
/// covariance C of all candidates and the noise σ_n², a visit of i takes C_ji² / (C_ii + σ_n²) off that of j
/// (Krause, Singh and Guestrin, Near-optimal sensor placements in Gaussian processes, JMLR 9 (2008): greedy
/// choice). So it is for a model that is learned anew from all states; CorrectionModel::add() keeps its
/// inducing points and gains less far from them. Fewer than `count` where a visit would take less than
/// kLeastGain of the uncertainty.
std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress = nullptr);
inline constexpr double kLeastGain = 1e-3;

/// Poses to choose from, at rest: a grid of `each` positions along each axis of the model's workspace, each
/// in the middle of its turns and turned to both ends about each axis; of these the ones near something
/// learned: an inducing point within a step of the grid along each axis and half of the range of turns about
/// each.
std::vector<State> posesWithin(const CorrectionModel& model, int each);

}  // namespace capstan::learning
