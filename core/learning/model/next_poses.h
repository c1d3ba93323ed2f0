#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// A query pose: the next pose to sample.
struct NextPose {
  std::size_t candidate = 0;  ///< place among the candidates
  double before = 0.0;        ///< uncertainty over all candidates before this query
  double after = 0.0;         ///< and what it will be
};

/// Query poses among `candidates`, chosen one after the other to lower the model's uncertainty of all, each
/// once: that which lowers the uncertainty most, the mean over the candidates of the correction's variance
/// over its variance without data (all outputs together, rotations by the lever). The variance of a Gaussian
/// process does not depend on the values observed, so each query's effect is known in advance: with the
/// covariance C of all candidates and the noise σ_n², a query at i lowers that of j by C_ji² / (C_ii + σ_n²)
/// (Krause, Singh and Guestrin, Near-optimal sensor placements in Gaussian processes, JMLR 9 (2008): greedy
/// choice). This holds for a model that is retrained on all states; CorrectionModel::add() keeps its
/// inducing points and gains less far from them. Fewer than `count` where a query would remove less than
/// kLeastGain of the uncertainty.
std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress = nullptr);
inline constexpr double kLeastGain = 1e-3;

/// Poses to choose from, at rest: a grid of `each` positions along each axis of the model's workspace, each
/// at its mean rotation and rotated to both limits about each axis. Only those near training data are
/// kept: an inducing point lies within a grid step along each axis and half of the range of rotations about
/// each.
std::vector<State> posesWithin(const CorrectionModel& model, int each);

}  // namespace capstan::learning
