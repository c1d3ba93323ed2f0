#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// A query pose: the next pose to sample.
struct NextPose {
  std::size_t candidate = 0;  ///< index of the candidate
  double before = 0.0;        ///< uncertainty over all candidates before this query
  double after = 0.0;         ///< uncertainty over all candidates after this query
};

/// Selects query poses from `candidates` one after the other, each candidate at most once. Each query is the
/// one that reduces the uncertainty most (greedy choice; Krause, Singh and Guestrin, Near-optimal sensor
/// placements in Gaussian processes, JMLR 9 (2008)). The uncertainty is the mean over all candidates of the
/// correction's variance divided by its variance without data (all outputs together, rotations by the lever).
/// The variance of a Gaussian process does not depend on the observed values, so the effect of a query is
/// known in advance: with the covariance C of all candidates and the noise σ_n², a query at i reduces the
/// variance at j by C_ji² / (C_ii + σ_n²). This holds for a model that is retrained on all states;
/// CorrectionModel::add() keeps the inducing points and improves less far from them. Returns fewer than
/// `count` poses if a query would remove less than kLeastGain of the uncertainty.
std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress = nullptr);
inline constexpr double kLeastGain = 1e-3;

/// Candidate poses at rest: a grid of `each` positions along each axis of the model's workspace. Each
/// position is used with the mean rotation and with rotations to both limits about each axis. Only poses near
/// training data are included: an inducing point lies within one grid step along each axis and half of the
/// range of rotations about each axis.
std::vector<State> posesWithin(const CorrectionModel& model, int each);

}  // namespace capstan::learning
