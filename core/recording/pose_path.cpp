#include "core/recording/pose_path.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/learning/poses/screen_poses.h"
#include "core/table_files/read_columns.h"

namespace capstan::recording {
namespace {

constexpr std::array<std::string_view, 7> kParts = {"x", "y", "z", "qx", "qy", "qz", "qw"};

struct Columns {
  table_files::TableLines lines;
  std::vector<double> trajectory, stamp;
  std::array<std::vector<double>, 7> part;
};

[[noreturn]] void refuse(const std::string& file, std::size_t line, std::string_view column, double value,
                         std::string what, std::string remedy) {
  throw base::InputError({file, static_cast<int>(line), std::string(column), fmt::format("{}", value),
                          std::move(what), std::move(remedy)});
}

Columns columnsOf(const table_files::ColumnReader& reader, const std::string& file) {
  Columns columns;
  columns.lines = reader.lines;
  reader.read([&](std::string_view name, std::size_t) -> std::vector<double>* {
    if (name == "traj") return &columns.trajectory;
    if (name == "t_s") return &columns.stamp;
    for (std::size_t i = 0; i < kParts.size(); ++i)
      if (name == kParts[i]) return &columns.part[i];
    return nullptr;
  });
  for (std::size_t i = 0; i < kParts.size(); ++i)
    if (columns.part[i].empty())
      throw base::InputError({file,
                              columns.lines.header(),
                              std::string(kParts[i]),
                              {},
                              "is missing",
                              "A path has the columns x, y, z, qx, qy, qz, qw, and optionally t_s and traj"});
  return columns;
}

learning::StampedPose poseOf(const Columns& columns, std::size_t row, const std::string& file) {
  learning::StampedPose pose;
  pose.row = columns.lines.number(row);
  pose.t = columns.stamp.empty() ? static_cast<double>(row) : columns.stamp[row];
  for (std::size_t i = 0; i < kParts.size(); ++i)
    if (!std::isfinite(columns.part[i][row]))
      refuse(file, pose.row, kParts[i], columns.part[i][row], "is not a number",
             "Give every row a complete pose");
  const auto part = [&](std::size_t i) { return columns.part[i][row]; };
  const Eigen::Quaterniond rotation(part(6), part(3), part(4), part(5));
  if (std::abs(rotation.norm() - 1.0) > learning::kNorm)
    refuse(file, pose.row, "qw", rotation.norm(), "is the norm of the quaternion, which must be 1",
           "Give unit quaternions as x, y, z, w");
  pose.pose.linear() = rotation.normalized().toRotationMatrix();
  pose.pose.translation() = Eigen::Vector3d(part(0), part(1), part(2));
  return pose;
}

}  // namespace

namespace {

PosePaths pathsOf(const Columns& columns, const std::string& file) {
  PosePaths all;
  all.timed = !columns.stamp.empty();
  for (std::size_t row = 0; row < columns.part[0].size(); ++row) {
    const double trajectory = columns.trajectory.empty() ? 0.0 : columns.trajectory[row];
    if (all.paths.empty() || all.paths.back().trajectory != trajectory) all.paths.push_back({trajectory, {}});
    std::vector<learning::StampedPose>& poses = all.paths.back().poses;
    learning::StampedPose pose = poseOf(columns, row, file);
    if (all.timed && !(std::isfinite(pose.t) && (poses.empty() || pose.t > poses.back().t)))
      refuse(file, pose.row, "t_s", pose.t, "is not after the stamp before",
             "Sort each trajectory by time and remove repeated rows");
    poses.push_back(pose);
  }
  return all;
}

}  // namespace

PosePaths parsePosePaths(std::string_view text, const std::string& file) {
  return readPosePaths(table_files::columnsOfCsv(text, file), file);
}

PosePaths readPosePaths(const table_files::ColumnReader& columns, const std::string& file) {
  return pathsOf(columnsOf(columns, file), file);
}

PosePaths readPosePaths(const std::filesystem::path& path) {
  return readPosePaths(table_files::columnsIn(path), path.string());
}

std::vector<learning::State> statesOf(const PosePaths& paths) {
  std::vector<learning::State> all;
  for (std::size_t m = 0; m < paths.paths.size(); ++m)
    for (learning::State state : learning::statesAlong(paths.paths[m].poses)) {
      if (!paths.timed) {
        state.velocity.setZero();
        for (learning::Vector6d& drift : state.drift) drift.setZero();
      }
      state.motion = m;
      all.push_back(state);
    }
  return all;
}

namespace {

/// x, y, z, qx, qy, qz, qw
std::string poseCells(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d p = pose.translation();
  const Eigen::Vector4d q = Eigen::Quaterniond(pose.linear()).coeffs();
  return fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", p.x(), p.y(), p.z(), q.x(), q.y(),
                     q.z(), q.w());
}

}  // namespace

std::string formatCorrected(const PosePaths& paths, const std::vector<learning::Corrected>& corrected) {
  std::string text = "traj,";
  if (paths.timed) text += "t_s,";
  text += "x,y,z,qx,qy,qz,qw,sigma_x,sigma_y,sigma_z,sigma_rx,sigma_ry,sigma_rz,confidence\n";
  std::size_t k = 0;
  for (const PosePath& path : paths.paths)
    for (const learning::StampedPose& pose : path.poses) {
      CAPSTAN_ASSERT(k < corrected.size());
      const learning::Corrected& one = corrected[k++];
      text += fmt::format("{},", path.trajectory);
      if (paths.timed) text += fmt::format("{},", pose.t);
      text += poseCells(one.pose);
      for (const double sigma : one.sigma) text += fmt::format(",{:.4g}", sigma);
      text += fmt::format(",{:.4f}\n", one.confidence);
    }
  return text;
}

std::vector<std::vector<learning::Waypoint>> plannedMotions(const PosePaths& paths, const std::string& file) {
  if (!paths.timed)
    throw base::InputError(
        {file, 1, "t_s", {}, "is missing: a path has a time at each waypoint", "Add the column"});
  std::vector<std::vector<learning::Waypoint>> motions;
  for (const PosePath& path : paths.paths) {
    std::vector<learning::Waypoint>& motion = motions.emplace_back();
    for (const learning::StampedPose& pose : path.poses) motion.push_back({pose.t, pose.pose});
  }
  return motions;
}

std::string formatCommands(const PosePaths& paths,
                           const std::vector<std::vector<learning::CorrectedWaypoint>>& commands) {
  CAPSTAN_CHECK(commands.size() == paths.paths.size());
  std::string text = "traj,t_s,x,y,z,qx,qy,qz,qw,confidence\n";
  for (std::size_t m = 0; m < commands.size(); ++m)
    for (const learning::CorrectedWaypoint& waypoint : commands[m])
      text += fmt::format("{},{},{},{:.4f}\n", paths.paths[m].trajectory, waypoint.t,
                          poseCells(waypoint.command), waypoint.confidence);
  return text;
}

}  // namespace capstan::recording
