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

namespace capstan::recording {

/// How the columns of each learning::StreamKind begin: "cam_x", "t_cam_s".
inline constexpr std::array<std::string_view, learning::kStreams> kStreamPrefixes = {"cam", "robot", "cmd"};

/// Parses a table of tip poses with columns traj, t_cam_s, cam_x, cam_y, cam_z, cam_qx, cam_qy, cam_qz,
/// cam_qw and the same of robot or cmd (or both), and task where known: stamps in seconds, each stream's own
/// clock; metres; unit quaternions. Rows of one trajectory stand together. Nothing is excluded
/// (learning::screenPoses does that). base::InputError naming file, line, column, value and remedy: a column
/// that is missing, a cell that is no number, no rows.
std::vector<learning::RawMotion> parsePoseTable(std::string_view text, const std::string& file);
std::vector<learning::RawMotion> readPoseTable(const std::filesystem::path& path);

/// The motions of several tables, one behind the other; each carries the name of its table, "monday,
/// trajectory 3". Of one table as readPoseTable(). Cancelled: those of the tables read until then.
/// base::InputError as readPoseTable(), and where a table is given twice, which would count twice.
std::vector<learning::RawMotion> readPoseTables(const std::vector<std::string>& paths,
                                                base::Progress* progress = nullptr);

/// The same of a table that may have no quaternions: all of a stream without them are of NaN.
std::vector<learning::RawMotion> parseTipTable(std::string_view text, const std::string& file);

/// Of one its path, of more "a.csv and 2 more tables".
std::string nameOfTables(const std::vector<std::string>& paths);

/// Calls `work`; a base::InputError of it that names no file gets the tables' names.
template <class Work>
auto namingTables(const std::vector<std::string>& paths, Work&& work) {
  return base::namingFile(nameOfTables(paths), std::forward<Work>(work));
}

}  // namespace capstan::recording
