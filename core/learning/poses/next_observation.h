#pragma once

#include <vector>

#include "core/learning/model/command_correction.h"

/// Choice of the next observation of the tool: motions are long where the correction's confidence is high,
/// and are divided into short pieces with an observation after each where it is low (GPR paper, section VI).
namespace capstan::learning {

/// Corrected::confidence below which a motion is divided. At 0.9 the standard deviation is a third of that
/// without data.
inline constexpr double kLeastConfidence = 0.9;
inline constexpr double kObservedPiece = 0.01;  ///< length of a piece of a divided motion [m]

/// Index of the waypoint at which to stop and observe next, after the observation at waypoint `from`. If all
/// waypoints ahead have high confidence, it is the last one. Otherwise it is the first one at a distance of
/// kObservedPiece along the desired path or the one before the first with low confidence, whichever is later.
std::size_t nextObservation(const std::vector<CorrectedWaypoint>& path, std::size_t from);

/// Rigid offset commanded · observed⁻¹ at an observed pose. It maps the remaining motion from the cameras'
/// frame to the robot's frame. It is the only correction of robots that observe continuously (Kehoe et al.,
/// ICRA 2014).
Eigen::Isometry3d offsetObserved(const Eigen::Isometry3d& commanded, const Eigen::Isometry3d& observed);

}  // namespace capstan::learning
