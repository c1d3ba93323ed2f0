#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/learning/model/command_correction.h"

namespace capstan::recording {

/// A motion to follow, in the frame in which cameras see.
struct PosePath {
  double trajectory = 0.0;  ///< as the table numbers it
  std::vector<learning::StampedPose> poses;
};

/// Paths of a table with columns x, y, z [m], qx, qy, qz, qw, and where known t_s (rising stamps [s]; without
/// them every pose is one to rest at) and traj (its rows stand together).
struct PosePaths {
  bool timed = false;
  std::vector<PosePath> paths;
};

/// Every row counts: base::InputError naming file, line, column, value and remedy for a column that is
/// missing, a cell that is no number, a quaternion whose norm is not 1 within 1 %, stamps that do not rise.
PosePaths parsePosePaths(std::string_view text, const std::string& file);
PosePaths readPosePaths(const std::filesystem::path& path);

/// States of the paths as inputs of a model: with velocities where rows are stamped, else at rest.
std::vector<learning::State> statesOf(const PosePaths& paths);

/// Table of the command, a line a row of the paths: traj, t_s (where timed), x, y, z, qx, qy, qz, qw,
/// then standard deviations sigma_x … [m] and sigma_rx … [rad] in the tool's frame, and confidence.
std::string formatCorrected(const PosePaths& paths, const std::vector<learning::Corrected>& corrected);

/// The paths as planned motions. base::InputError with `file`: they have no t_s.
std::vector<std::vector<learning::Waypoint>> plannedMotions(const PosePaths& paths, const std::string& file);
/// Table of commands along motions, a line a waypoint: traj, t_s, x, y, z, qx, qy, qz, qw, confidence.
/// `commands` has one path for each of `paths`.
std::string formatCommands(const PosePaths& paths,
                           const std::vector<std::vector<learning::CorrectedWaypoint>>& commands);

}  // namespace capstan::recording
