#pragma once

#include <memory>
#include <string>

#include "core/simulation/trajectory.h"

namespace capstan::simulation {

/// Returns a trajectory that replays the columns q1, q2, q3 of the measured table (CSV) `file` from its first
/// row on. Cubic Hermite segments interpolate; central differences give their slopes. Throws base::InputError
/// when the table is unusable, has fewer than two rows, or has an empty cell in q1, q2 or q3.
std::unique_ptr<Trajectory> recordedTrajectory(const std::string& file);

}  // namespace capstan::simulation
