#include "core/diagnosis/evidence/pose_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/recording/pose_table.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNorm = 0.01;  // largest difference of an orientation's norm from 1

using learning::RawMotion;
using learning::RawPose;
using learning::StreamKind;

[[noreturn]] void refuse(const std::string& file, const RawPose& pose, std::string column, double value,
                         std::string reason, std::string remedy) {
  throw base::InputError({file, static_cast<int>(pose.row), std::move(column), fmt::format("{}", value),
                          std::move(reason), std::move(remedy)});
}

bool hasTurn(const RawPose& pose) { return pose.quaternion.allFinite(); }

/// True if any row of the stream has an orientation.
bool turns(const std::vector<RawMotion>& motions, StreamKind kind) {
  const auto at = static_cast<std::size_t>(kind);
  return std::any_of(motions.begin(), motions.end(), [at](const RawMotion& motion) {
    return std::any_of(motion.streams[at].begin(), motion.streams[at].end(), hasTurn);
  });
}

/// One stream of one table.
struct List {
  const std::string& file;
  std::string_view prefix;
  bool turns;
};

/// The row's pose; nothing for a placeholder.
std::optional<Pose> poseOf(const RawPose& raw, const List& list) {
  Pose pose;
  pose.t = raw.t;
  pose.position = raw.position;
  const Eigen::Vector4d rotation = list.turns ? raw.quaternion : Eigen::Vector4d(0.0, 0.0, 0.0, 1.0);
  if (!std::isfinite(pose.t) || !pose.position.allFinite() || !rotation.allFinite()) return std::nullopt;
  if (pose.position.isZero(0.0) && rotation.head<3>().isZero(0.0)) return std::nullopt;
  if (std::abs(rotation.norm() - 1.0) > kNorm)
    refuse(list.file, raw, fmt::format("{}_qw", list.prefix), rotation[3],
           fmt::format("the orientation has norm {:.4g} and not 1", rotation.norm()),
           "Write unit quaternions x, y, z, w, or leave the cells empty");
  pose.rotation = Eigen::Quaterniond(rotation[3], rotation[0], rotation[1], rotation[2]).normalized();
  return pose;
}

std::vector<Pose> posesOf(const std::vector<RawPose>& rows, const List& list, PoseCounts& counts) {
  std::vector<Pose> poses;
  counts.rows += rows.size();
  for (const RawPose& raw : rows) {
    const std::optional<Pose> pose = poseOf(raw, list);
    if (!pose) {
      ++counts.placeholders;
    } else if (!poses.empty() && pose->t == poses.back().t) {
      ++counts.repeats;
    } else {
      if (!poses.empty() && pose->t < poses.back().t)
        refuse(list.file, raw, fmt::format("t_{}_s", list.prefix), pose->t,
               fmt::format("is earlier than {} before it, in the same trajectory", poses.back().t),
               "Order each trajectory's rows by time");
      poses.push_back(*pose);
    }
  }
  return poses;
}

/// Marks outliers and returns their number: observations outside of the longest sequence in which each is
/// within reach of the one before.
std::size_t markOutliers(std::vector<Pose>& observations) {
  const std::size_t n = observations.size();
  std::vector<std::size_t> length(n, 1), before(n, n);
  std::size_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j-- > 0;) {
      const double way = (observations[i].position - observations[j].position).norm();
      if (length[j] < length[i] || way > kFastestTip * (observations[i].t - observations[j].t) + kStray)
        continue;
      length[i] = length[j] + 1;
      before[i] = j;
    }
    if (length[i] > length[last]) last = i;
  }
  for (Pose& observation : observations) observation.counts = false;
  for (std::size_t i = last; i < n; i = before[i]) observations[i].counts = true;
  return n == 0 ? 0 : n - length[last];
}

void addNotices(PoseEvidence& evidence, std::size_t too_short) {
  const auto say = [&](const char* what, const PoseCounts& counts) {
    if (counts.rows == 0) return;
    std::string line =
        fmt::format("{}: {} {} poses in {} rows; {} placeholders and {} repeats excluded", evidence.title,
                    counts.poses(), what, counts.rows, counts.placeholders, counts.repeats);
    if (counts.outliers > 0)
      line += fmt::format(", {} outliers beyond the reach of any tip do not count", counts.outliers);
    evidence.notices.push_back(std::move(line));
  };
  say("camera", evidence.camera);
  say("robot", evidence.robot);
  say("command", evidence.command);
  if (too_short > 0)
    evidence.notices.push_back(
        fmt::format("{}: {} trajectories are too short to compare", evidence.title, too_short));
}

}  // namespace

bool isPoseTable(std::string_view header_line) {
  const std::string header = "," + std::string(header_line) + ",";
  const auto has = [&](const char* name) { return header.find(name) != std::string::npos; };
  return has(",traj,") && has(",t_cam_s,") && has(",cam_x,");
}

PoseEvidence readPoseEvidence(const table_files::ColumnReader& reader, const std::string& file) {
  const std::vector<RawMotion> motions = recording::parseTipTable(reader, file);
  PoseEvidence evidence;
  evidence.file = file;
  evidence.title = std::filesystem::path(file).filename().string();
  std::array<bool, learning::kStreams> rotated;
  for (std::size_t s = 0; s < rotated.size(); ++s) rotated[s] = turns(motions, static_cast<StreamKind>(s));
  evidence.turns = rotated[1] || rotated[2];
  std::size_t too_short = 0;
  for (const RawMotion& motion : motions) {
    const auto poses = [&](std::size_t s, PoseCounts& counts) {
      return posesOf(motion.streams[s], {file, recording::kStreamPrefixes[s], rotated[s]}, counts);
    };
    PoseTrajectory trajectory;
    trajectory.name = motion.name;
    trajectory.camera = poses(0, evidence.camera);
    trajectory.robot = poses(1, evidence.robot);
    trajectory.command = poses(2, evidence.command);
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
                            "no trajectory has two observations and two poses to compare with",
                            "Record at least one motion with camera and robot"});
  addNotices(evidence, too_short);
  return evidence;
}

PoseEvidence parsePoseEvidence(std::string_view text, const std::string& file) {
  return readPoseEvidence(table_files::columnsOfCsv(text, file), file);
}

PoseEvidence readPoseEvidence(const std::filesystem::path& path) {
  return readPoseEvidence(table_files::columnsIn(path), path.string());
}

}  // namespace capstan::diagnosis
