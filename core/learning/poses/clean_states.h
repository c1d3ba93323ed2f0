#pragma once

#include "core/learning/poses/states.h"

namespace capstan::learning {

/// Limits for cleaning states.
struct CleaningOptions {
  MedianOptions median = {};
  /// Largest distance of observed positions outside the box of commanded ones [m].
  static constexpr double kMargin = 0.03;
  static constexpr double kMaxRotation = 1.0;      ///< largest rotation residual of the rigid offset [rad]
  static constexpr double kMostSpeed = 0.2;        ///< largest speed [m/s]; the paper's robot moved at 0.05
  static constexpr double kMaxRotationRate = 6.0;  ///< largest rotation rate [rad/s]
  /// Share of misplaced states beyond which a trajectory is rejected completely: the paper's P.
  double most_rejected = 0.9;
};

/// True for kOutlier, kTooFarTurned and kOutside. Speed reasons do not count: beside a jump the speed of a
/// good state is wrong, too.
bool misplaced(Reason reason);

/// True if the state is faster than kMostSpeed or kMaxRotationRate.
bool tooFast(const State& state);

struct CleaningReport {
  std::vector<Reason> reason;                                ///< by state; kNone: inlier
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid offset by the least median of squares
  double deviation = 0.0;                                    ///< robust standard deviation of the inliers [m]
  Eigen::AlignedBox3d workspace;  ///< box of commanded positions, extended by kMargin [m]
  std::size_t count(Reason reason) const;
  std::size_t kept() const { return count(Reason::kNone); }
};

/// Cleans states (GPR paper, section IV-A). Inliers are within the distance limit of the least median of
/// squares and within the limits of rotation, position, speed and rotation rate, tested in this order; a
/// rejected state has the first reason that applies. A trajectory with a share of more than `most_rejected`
/// misplaced states is rejected completely.
CleaningReport cleanStates(const std::vector<State>& states, const CleaningOptions& options = {});

/// Applies the result of an earlier cleaning (offset, distance limit, workspace) to other states, with the
/// same rule for whole trajectories.
std::vector<Reason> judgedBy(const CleaningReport& found, const std::vector<State>& states,
                             const CleaningOptions& options = {});

/// The inliers of `states`.
std::vector<State> kept(const std::vector<State>& states, const CleaningReport& report);

}  // namespace capstan::learning
