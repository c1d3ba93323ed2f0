#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/learning/poses/pose_motion.h"
#include "core/table_files/read_columns.h"

namespace capstan::recording {

/// Prefix of the columns of each learning::StreamKind, as in "cam_x" and "t_cam_s".
inline constexpr std::array<std::string_view, learning::kStreams> kStreamPrefixes = {"cam", "robot", "cmd"};

/// Parses a table of tip poses with the columns traj, t_cam_s, cam_x, cam_y, cam_z, cam_qx, cam_qy, cam_qz,
/// cam_qw, the same columns of robot or cmd (or both), and optionally task. Stamps are in seconds on each
/// stream's own clock, positions in metres, rotations unit quaternions. Rows of one trajectory are
/// contiguous. No row is excluded (learning::screenPoses does that). Throws base::InputError naming file,
/// line, column, value and remedy for a missing column, a cell that is not a number, or no rows.
std::vector<learning::RawMotion> parsePoseTable(std::string_view text, const std::string& file);
/// The same of a file of any kind of table_files::tableKinds(), and of columns that are in memory.
std::vector<learning::RawMotion> readPoseTable(const std::filesystem::path& path);
std::vector<learning::RawMotion> readPoseTable(const table_files::ColumnReader& columns,
                                               const std::string& file);

/// Motions of several tables, one after the other; each motion has the name of its table, "monday, trajectory
/// 3". For one table, like readPoseTable(). If cancelled, returns the motions of the tables read so far.
/// Throws base::InputError as readPoseTable(), and for a table that is given twice, because its data would
/// count twice.
std::vector<learning::RawMotion> readPoseTables(const std::vector<std::string>& paths,
                                                base::Progress* progress = nullptr);

/// Parses a pose table whose streams may lack quaternions; these are then NaN.
std::vector<learning::RawMotion> parseTipTable(const table_files::ColumnReader& reader,
                                               const std::string& file);

/// Name of the tables for messages: the path of a single table, otherwise "a.csv and 2 more tables".
std::string nameOfTables(const std::vector<std::string>& paths);

/// Calls `work`; adds the tables' names to a base::InputError that names no file.
template <class Work>
auto namingTables(const std::vector<std::string>& paths, Work&& work) {
  return base::namingFile(nameOfTables(paths), std::forward<Work>(work));
}

}  // namespace capstan::recording
