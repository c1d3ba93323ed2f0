#pragma once

#include <vector>

#include "core/learning/model/command_correction.h"

/// When to observe the tool again: long motions where the correction's confidence is high, short pieces with
/// an observation between them where it is low (GPR paper, section VI).
namespace capstan::learning {

struct ObservationOptions {
  /// Corrected::confidence below which a motion is divided; at 0.9 a third of the standard deviation without
  /// data remains.
  double least_confidence = 0.9;
  double piece = 0.01;  ///< length of such a piece [m]
};

/// Index of the waypoint at which to stop and observe next, after the observation at waypoint `from`: the
/// last one if all ahead have high confidence; else the first at a distance of `piece` along the desired
/// path, or the one before the first with low confidence, whichever is later.
std::size_t nextObservation(const std::vector<CorrectedWaypoint>& path, std::size_t from,
                            const ObservationOptions& options);

/// Rigid offset at the place of an observation, commanded · observed⁻¹: it maps the remaining motion from the
/// cameras' frame to the robot's. It is the only correction of robots that observe all the time (Kehoe et
/// al., ICRA 2014).
Eigen::Isometry3d offsetObserved(const Eigen::Isometry3d& commanded, const Eigen::Isometry3d& observed);

}  // namespace capstan::learning
