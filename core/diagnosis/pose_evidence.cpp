#include "core/diagnosis/pose_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/session/csv.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNorm = 0.01;  // by which an orientation's norm may miss 1

/// Columns of one list: the stamp, the position, the turn.
constexpr std::array<std::string_view, 7> kParts = {"x", "y", "z", "qx", "qy", "qz", "qw"};

struct List {
  std::string prefix;  ///< "cam"
  std::vector<double> stamp;
  std::array<std::vector<double>, 7> part;

  std::string column(std::size_t i) const { return fmt::format("{}_{}", prefix, kParts[i]); }
  std::string stampColumn() const { return fmt::format("t_{}_s", prefix); }
  bool there() const { return !stamp.empty(); }
  bool turns() const { return !part[3].empty(); }
};

struct Table {
  std::string file;
  std::vector<double> task, trajectory;
  std::array<List, 3> lists = {List{"cam", {}, {}}, List{"robot", {}, {}}, List{"cmd", {}, {}}};

  std::size_t rows() const { return trajectory.size(); }
  [[noreturn]] void refuse(std::size_t row, std::string column, std::string value, std::string reason,
                           std::string remedy) const {
    throw base::InputError({file, static_cast<int>(row) + 2, std::move(column), std::move(value),
                            std::move(reason), std::move(remedy)});
  }
};

std::vector<double>* targetOf(Table& table, std::string_view name) {
  if (name == "task") return &table.task;
  if (name == "traj") return &table.trajectory;
  for (List& list : table.lists) {
    if (name == list.stampColumn()) return &list.stamp;
    for (std::size_t i = 0; i < kParts.size(); ++i)
      if (name == list.column(i)) return &list.part[i];
  }
  return nullptr;
}

void need(const Table& table, const std::vector<double>& column, const std::string& name) {
  if (column.empty())
    throw base::InputError({table.file,
                            1,
                            name,
                            {},
                            "this column is missing",
                            "Give traj, t_cam_s, cam_x, cam_y, cam_z and the same of robot or cmd"});
}

void checkColumns(const Table& table) {
  need(table, table.trajectory, "traj");
  const List &camera = table.lists[0], &robot = table.lists[1], &command = table.lists[2];
  need(table, camera.stamp, camera.stampColumn());
  if (!robot.there() && !command.there()) need(table, robot.stamp, robot.stampColumn());
  for (const List& list : table.lists) {
    if (!list.there()) continue;
    for (std::size_t i = 0; i < 3; ++i) need(table, list.part[i], list.column(i));
    const bool any = std::any_of(list.part.begin() + 3, list.part.end(), [](auto& c) { return !c.empty(); });
    for (std::size_t i = 3; any && i < kParts.size(); ++i) need(table, list.part[i], list.column(i));
  }
}

/// Nothing: a placeholder.
std::optional<Pose> poseAt(const Table& table, const List& list, std::size_t row) {
  Pose pose;
  pose.t = list.stamp[row];
  pose.position = {list.part[0][row], list.part[1][row], list.part[2][row]};
  Eigen::Vector4d turn(0.0, 0.0, 0.0, 1.0);
  if (list.turns()) turn = {list.part[3][row], list.part[4][row], list.part[5][row], list.part[6][row]};
  if (!std::isfinite(pose.t) || !pose.position.allFinite() || !turn.allFinite()) return std::nullopt;
  if (pose.position.isZero(0.0) && turn.head<3>().isZero(0.0)) return std::nullopt;
  if (std::abs(turn.norm() - 1.0) > kNorm)
    table.refuse(row, list.column(6), fmt::format("{}", turn[3]),
                 fmt::format("the orientation has norm {:.4g} and not 1", turn.norm()),
                 "Write unit quaternions x, y, z, w, or leave the cells empty");
  pose.turn = Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]).normalized();
  return pose;
}

std::vector<Pose> posesOf(const Table& table, const List& list, std::size_t begin, std::size_t end,
                          PoseCounts& counts) {
  std::vector<Pose> poses;
  if (!list.there()) return poses;
  counts.rows += end - begin;
  for (std::size_t row = begin; row < end; ++row) {
    const std::optional<Pose> pose = poseAt(table, list, row);
    if (!pose) {
      ++counts.placeholders;
    } else if (!poses.empty() && pose->t == poses.back().t) {
      ++counts.repeats;
    } else {
      if (!poses.empty() && pose->t < poses.back().t)
        table.refuse(row, list.stampColumn(), fmt::format("{}", pose->t),
                     fmt::format("goes back behind {} within a trajectory", poses.back().t),
                     "Order each trajectory's rows by time");
      poses.push_back(*pose);
    }
  }
  return poses;
}

/// Longest chain of sights, each within reach of the one before; the rest does not count.
std::size_t markOutliers(std::vector<Pose>& sights) {
  const std::size_t n = sights.size();
  std::vector<std::size_t> length(n, 1), before(n, n);
  std::size_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j-- > 0;) {
      const double way = (sights[i].position - sights[j].position).norm();
      if (length[j] < length[i] || way > kFastestTip * (sights[i].t - sights[j].t) + kStray) continue;
      length[i] = length[j] + 1;
      before[i] = j;
    }
    if (length[i] > length[last]) last = i;
  }
  for (Pose& sight : sights) sight.counts = false;
  for (std::size_t i = last; i < n; i = before[i]) sights[i].counts = true;
  return n == 0 ? 0 : n - length[last];
}

void addNotices(PoseEvidence& evidence, std::size_t too_short) {
  const auto say = [&](const char* what, const PoseCounts& counts) {
    if (counts.rows == 0) return;
    std::string line =
        fmt::format("{}: {} {} poses in {} rows; {} placeholders and {} repeats left out", evidence.title,
                    counts.poses(), what, counts.rows, counts.placeholders, counts.repeats);
    if (counts.outliers > 0)
      line += fmt::format(", {} that no tip could have reached do not count", counts.outliers);
    evidence.notices.push_back(std::move(line));
  };
  say("camera", evidence.camera);
  say("robot", evidence.robot);
  say("command", evidence.command);
  if (too_short > 0)
    evidence.notices.push_back(
        fmt::format("{}: {} trajectories too short to compare", evidence.title, too_short));
}

std::string nameOf(const Table& table, std::size_t row) {
  const std::string trajectory = fmt::format("trajectory {}", table.trajectory[row]);
  return table.task.empty() ? trajectory : fmt::format("task {}, {}", table.task[row], trajectory);
}

}  // namespace

bool isPoseTable(std::string_view header_line) {
  const std::string header = "," + std::string(header_line) + ",";
  const auto has = [&](const char* name) { return header.find(name) != std::string::npos; };
  return has(",traj,") && has(",t_cam_s,") && has(",cam_x,");
}

PoseEvidence parsePoseEvidence(std::string_view text, const std::string& file) {
  Table table;
  table.file = file;
  session::parseCsv(text, file, [&](std::string_view name, std::size_t) { return targetOf(table, name); });
  checkColumns(table);
  PoseEvidence evidence;
  evidence.file = file;
  evidence.title = std::filesystem::path(file).filename().string();
  evidence.turns = table.lists[1].turns() || table.lists[2].turns();
  const auto differ = [&](std::size_t a, std::size_t b) {
    return table.trajectory[a] != table.trajectory[b] ||
           (!table.task.empty() && table.task[a] != table.task[b]);
  };
  std::size_t too_short = 0;
  for (std::size_t begin = 0, end = 0; begin < table.rows(); begin = end) {
    for (end = begin + 1; end < table.rows() && !differ(begin, end);) ++end;
    PoseTrajectory trajectory;
    trajectory.name = nameOf(table, begin);
    trajectory.camera = posesOf(table, table.lists[0], begin, end, evidence.camera);
    trajectory.robot = posesOf(table, table.lists[1], begin, end, evidence.robot);
    trajectory.command = posesOf(table, table.lists[2], begin, end, evidence.command);
    evidence.camera.outliers += markOutliers(trajectory.camera);
    const bool enough =
        trajectory.camera.size() > 1 && std::max(trajectory.robot.size(), trajectory.command.size()) > 1;
    if (enough)
      evidence.trajectories.push_back(std::move(trajectory));
    else
      ++too_short;
  }
  if (evidence.trajectories.empty())
    throw base::InputError({file,
                            0,
                            "traj",
                            {},
                            "no trajectory has two sights and two poses to compare with",
                            "Record at least one motion with camera and robot"});
  addNotices(evidence, too_short);
  return evidence;
}

PoseEvidence readPoseEvidence(const std::filesystem::path& path) {
  return parsePoseEvidence(base::readTextFile(path), path.string());
}

}  // namespace capstan::diagnosis
