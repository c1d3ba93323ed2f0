#pragma once

#include <vector>

#include "core/learning/model/command_correction.h"

/// When to look again: long motions where the correction is sure, short pieces with a look in between where
/// it is not (GPR paper, section VI).
namespace capstan::learning {

struct ObservationOptions {
  /// Corrected::confidence below which a motion is cut up; at 0.9 a third of what is uncertain without data
  /// is left.
  double least_confidence = 0.9;
  double piece = 0.01;  ///< length of what is moved unseen then [m]
};

/// Place in the path of the waypoint at which to stop and look next, having looked at waypoint `from`: the
/// last one where all that lie ahead are sure; else the first that is `piece` of desired way on, or the one
/// before the first that is not sure, whichever comes later.
std::size_t nextObservation(const std::vector<CorrectedWaypoint>& path, std::size_t from,
                            const ObservationOptions& options);

/// What to ask for, from a look: the robot was asked for `told` and is seen at `seen`; told · seen⁻¹ is the
/// rigid offset of that place, and takes the rest of a motion from the cameras' frame to the robot's. It is
/// the only correction of robots that look all the time (Kehoe et al., ICRA 2014).
Eigen::Isometry3d offsetObserved(const Eigen::Isometry3d& commanded, const Eigen::Isometry3d& observed);

}  // namespace capstan::learning
