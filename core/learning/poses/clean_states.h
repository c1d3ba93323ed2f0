#pragma once

#include "core/learning/poses/states.h"

namespace capstan::learning {

/// What the robot can do.
struct CleaningOptions {
  MedianOptions median = {};
  static constexpr double kMaxRotation =
      1.0;               ///< of observed from commanded poses, less the rigid offset [rad]
  double margin = 0.03;  ///< of observed positions outside of the box of commanded ones [m]
  static constexpr double kMostSpeed = 0.2;        ///< [m/s]: the paper's robot was driven at 0.05
  static constexpr double kMaxRotationRate = 6.0;  ///< [rad/s]
  double most_rejected = 0.9;  ///< share of a trajectory, beyond which all of it goes: the paper's P
};

/// True for kOutlier, kTooFarTurned and kOutside. Speed reasons do not count: beside a jump the speed of a good state
/// is wrong, too.
bool misplaced(Reason reason);

/// Faster than the robot moves or turns?
bool tooFast(const State& state);

struct CleaningReport {
  std::vector<Reason> reason;                                ///< by state; kNone: it counts
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< of the least median of squares
  double deviation = 0.0;                                    ///< robust, of what belongs [m]
  Eigen::AlignedBox3d workspace;  ///< of commanded positions, widened by the margin [m]
  std::size_t count(Reason reason) const;
  std::size_t kept() const { return count(Reason::kNone); }
};

/// Which states a robot can have been in (GPR paper, section IV-A): within reach of the least median of
/// squares, and within limits of turn, position, speed and rotation rate; a trajectory of which more than
/// `most_rejected` is out of place goes as a whole. Each state that goes has the first reason of these.
CleaningReport cleanStates(const std::vector<State>& states, const CleaningOptions& options = {});

/// Applies the result of an earlier cleaning (offset, distance limit, workspace) to other states, with the same rule
/// for whole trajectories.
std::vector<Reason> judgedBy(const CleaningReport& found, const std::vector<State>& states,
                             const CleaningOptions& options = {});

/// The states that count.
std::vector<State> kept(const std::vector<State>& states, const CleaningReport& report);

}  // namespace capstan::learning
