#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/learning/model/command_correction.h"
#include "core/table_files/read_columns.h"

namespace capstan::recording {

/// A desired motion in the frame of the cameras.
struct PosePath {
  double trajectory = 0.0;  ///< number of the trajectory in the table
  std::vector<learning::StampedPose> poses;
};

/// Paths of a table with the columns x, y, z [m], qx, qy, qz, qw. Optional columns: t_s (increasing stamps
/// [s]; without t_s the robot rests at every pose) and traj (rows of one trajectory are contiguous).
struct PosePaths {
  bool timed = false;
  std::vector<PosePath> paths;
};

/// Parses such a table; no row is excluded. Throws base::InputError naming file, line, column, value and
/// remedy for a missing column, a cell that is not a number, a quaternion whose norm differs from 1 by more
/// than 1 %, or stamps that do not increase.
PosePaths parsePosePaths(std::string_view text, const std::string& file);
PosePaths readPosePaths(const std::filesystem::path& path);
/// The same of columns that are in memory; `file` names them in errors.
PosePaths readPosePaths(const table_files::ColumnReader& columns, const std::string& file);

/// States of the paths as inputs of a model: with velocities if rows have stamps, else at rest.
std::vector<learning::State> statesOf(const PosePaths& paths);

/// CSV table of commands, one line per row of the paths: traj, t_s (if timed), x, y, z, qx, qy, qz, qw, then
/// standard deviations sigma_x … [m] and sigma_rx … [rad] in the tool's frame, and confidence.
std::string formatCorrected(const PosePaths& paths, const std::vector<learning::Corrected>& corrected);

/// Converts the paths to planned motions. Throws base::InputError with `file` if they have no t_s.
std::vector<std::vector<learning::Waypoint>> plannedMotions(const PosePaths& paths, const std::string& file);
/// CSV table of commands along motions, one line per waypoint: traj, t_s, x, y, z, qx, qy, qz, qw,
/// confidence. `commands` has one path for each of `paths`.
std::string formatCommands(const PosePaths& paths,
                           const std::vector<std::vector<learning::CorrectedWaypoint>>& commands);

}  // namespace capstan::recording
