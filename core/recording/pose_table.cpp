#include "core/recording/pose_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/table_files/read_columns.h"

namespace capstan::recording {
namespace {

constexpr std::array<std::string_view, 7> kParts = {"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr std::size_t kPositions = 3;  // number of position columns among these

/// Columns of one stream: stamp, position and quaternion.
struct StreamColumns {
  std::vector<double> stamp;
  std::array<std::vector<double>, 7> part;
  bool turns() const {
    return std::any_of(part.begin() + kPositions, part.end(), [](const auto& c) { return !c.empty(); });
  }
};

struct Columns {
  table_files::TableLines lines;
  std::vector<double> task, trajectory;
  std::array<StreamColumns, learning::kStreams> streams;

  std::vector<double>* named(std::string_view name) {
    if (name == "task") return &task;
    if (name == "traj") return &trajectory;
    for (std::size_t s = 0; s < streams.size(); ++s) {
      if (name == fmt::format("t_{}_s", kStreamPrefixes[s])) return &streams[s].stamp;
      for (std::size_t i = 0; i < kParts.size(); ++i)
        if (name == fmt::format("{}_{}", kStreamPrefixes[s], kParts[i])) return &streams[s].part[i];
    }
    return nullptr;
  }
};

void need(const Columns& columns, const std::vector<double>& column, const std::string& name,
          const std::string& file) {
  if (column.empty())
    throw base::InputError({file,
                            columns.lines.header(),
                            name,
                            {},
                            "this column is missing",
                            "Give traj, t_cam_s, cam_x, cam_y, cam_z, quaternions cam_qx … cam_qw, and the "
                            "same of robot or cmd"});
}

/// Checks the columns: stamps and positions of cameras and of robot or command must exist, and all or no
/// parts of a quaternion.
void check(const Columns& columns, const std::string& file) {
  need(columns, columns.trajectory, "traj", file);
  const bool robot = !columns.streams[1].stamp.empty(), command = !columns.streams[2].stamp.empty();
  for (std::size_t s = 0; s < columns.streams.size(); ++s) {
    const StreamColumns& stream = columns.streams[s];
    const bool desired = s == 0 || !stream.stamp.empty() || (!robot && !command);
    if (!desired) continue;
    need(columns, stream.stamp, fmt::format("t_{}_s", kStreamPrefixes[s]), file);
    const std::size_t parts = stream.turns() ? kParts.size() : kPositions;
    for (std::size_t i = 0; i < parts; ++i)
      need(columns, stream.part[i], fmt::format("{}_{}", kStreamPrefixes[s], kParts[i]), file);
  }
}

void checkTurns(const Columns& columns, const std::string& file) {
  for (std::size_t s = 0; s < columns.streams.size(); ++s)
    if (!columns.streams[s].stamp.empty())
      need(columns, columns.streams[s].part[kPositions],
           fmt::format("{}_{}", kStreamPrefixes[s], kParts[kPositions]), file);
}

learning::RawPose rawPose(const StreamColumns& columns, std::size_t row,
                          const table_files::TableLines& lines) {
  learning::RawPose raw;
  raw.row = lines.number(row);
  raw.t = columns.stamp[row];
  const auto part = [&](std::size_t i) { return columns.part[i][row]; };
  raw.position = {part(0), part(1), part(2)};
  raw.quaternion.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (columns.turns()) raw.quaternion = {part(3), part(4), part(5), part(6)};
  return raw;
}

Columns columnsOf(const table_files::ColumnReader& reader, const std::string& file) {
  Columns columns;
  columns.lines = reader.lines;
  std::set<const std::vector<double>*> found;
  reader.read([&](std::string_view name, std::size_t) {
    std::vector<double>* const column = columns.named(name);
    if (column && !found.insert(column).second)
      throw base::InputError({file,
                              columns.lines.header(),
                              std::string(name),
                              {},
                              "is in the header twice",
                              "Rename or remove one"});
    return column;
  });
  check(columns, file);
  return columns;
}

std::vector<learning::RawMotion> motionsOf(const Columns& columns, const std::string& file) {
  std::vector<learning::RawMotion> motions;
  for (std::size_t row = 0; row < columns.trajectory.size(); ++row) {
    const bool same = row > 0 && columns.trajectory[row] == columns.trajectory[row - 1] &&
                      (columns.task.empty() || columns.task[row] == columns.task[row - 1]);
    if (!same) {
      const std::string trajectory = fmt::format("trajectory {}", columns.trajectory[row]);
      motions.push_back(
          {columns.task.empty() ? trajectory : fmt::format("task {}, {}", columns.task[row], trajectory),
           {},
           file});
    }
    for (std::size_t s = 0; s < columns.streams.size(); ++s)
      if (!columns.streams[s].stamp.empty())
        motions.back().streams[s].push_back(rawPose(columns.streams[s], row, columns.lines));
  }
  return motions;
}

}  // namespace

std::vector<learning::RawMotion> readPoseTable(const table_files::ColumnReader& reader,
                                               const std::string& file) {
  const Columns columns = columnsOf(reader, file);
  checkTurns(columns, file);
  return motionsOf(columns, file);
}

std::vector<learning::RawMotion> parsePoseTable(std::string_view text, const std::string& file) {
  return readPoseTable(table_files::columnsOfCsv(text, file), file);
}

std::vector<learning::RawMotion> readPoseTable(const std::filesystem::path& path) {
  return readPoseTable(table_files::columnsIn(path), path.string());
}

std::vector<learning::RawMotion> parseTipTable(const table_files::ColumnReader& reader,
                                               const std::string& file) {
  return motionsOf(columnsOf(reader, file), file);
}

namespace {

void checkDistinct(const std::vector<std::string>& paths) {
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b)
      if (base::sameRecording(paths[a], paths[b]))
        throw base::InputError(
            {paths[b], 0, {}, {}, "is given twice: its motions would count twice", "Give each table once"});
}

/// The file's name without its suffix, or its whole path if another table has the same name.
std::string shortName(const std::string& path, const std::vector<std::string>& paths) {
  const std::string name = std::filesystem::path(path).stem().string();
  const auto same = std::count_if(paths.begin(), paths.end(), [&](const std::string& other) {
    return std::filesystem::path(other).stem() == name;
  });
  return same > 1 ? path : name;
}

}  // namespace

std::vector<learning::RawMotion> readPoseTables(const std::vector<std::string>& paths,
                                                base::Progress* progress) {
  checkDistinct(paths);
  std::vector<learning::RawMotion> all;
  for (const std::string& path : paths) {
    if (progress && progress->cancelled()) break;
    const std::string name = shortName(path, paths);
    if (progress) progress->report(0.0, "reading " + name);
    for (learning::RawMotion& motion : readPoseTable(path)) {
      if (paths.size() > 1) motion.name = name + ", " + motion.name;
      all.push_back(std::move(motion));
    }
  }
  return all;
}

std::string nameOfTables(const std::vector<std::string>& paths) {
  if (paths.size() < 2) return paths.empty() ? std::string() : paths.front();
  return fmt::format("{} and {} more table{}", paths.front(), paths.size() - 1, paths.size() > 2 ? "s" : "");
}

}  // namespace capstan::recording
