#pragma once

#include <memory>
#include <string>

#include "core/simulation/trajectory.h"

namespace capstan::simulation {

/// Replays the columns q1, q2, q3 of the measured table (CSV) at `file`, from its first row on, on cubic
/// Hermite pieces with the slopes of central differences. Throws base::InputError when the table is unusable,
/// has fewer than two rows or an empty cell among q1, q2, q3.
std::unique_ptr<Trajectory> recordedTrajectory(const std::string& file);

}  // namespace capstan::simulation
