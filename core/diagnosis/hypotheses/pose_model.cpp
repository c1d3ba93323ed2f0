#include "core/diagnosis/hypotheses/pose_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace capstan::diagnosis {
namespace {

/// True if `t` is inside the path, at least kBefore after its start, and in no gap.
bool comparable(const std::vector<double>& path, double t) {
  if (t < path.front() + kBefore || t > path.back()) return false;
  const auto after = std::lower_bound(path.begin() + 1, path.end(), t);
  return after != path.end() && *after - *(after - 1) <= kLongestGap;
}

PoseMotion motionOf(const PoseTrajectory& trajectory, const std::vector<Pose>& path) {
  PoseMotion motion;
  motion.name = trajectory.name;
  motion.path.resize(3, static_cast<Eigen::Index>(path.size()));
  for (std::size_t i = 0; i < path.size(); ++i) {
    motion.t.push_back(path[i].t);
    motion.path.col(static_cast<Eigen::Index>(i)) = path[i].position;
    motion.rotation.push_back(path[i].rotation);
  }
  motion.observed.resize(3, static_cast<Eigen::Index>(trajectory.camera.size()));
  Eigen::Index n = 0;
  for (const Pose& observation : trajectory.camera) {
    if (!observation.counts || !comparable(motion.t, observation.t)) continue;
    motion.t_seen.push_back(observation.t);
    motion.observed.col(n++) = observation.position;
  }
  motion.observed.conservativeResize(3, n);
  return motion;
}

/// Moves each point by the marker offset and by the insertion offset.
void moveTool(const PoseNumbers& numbers, const PoseMotion& motion, Eigen::Matrix3Xd& path) {
  if (!numbers.marker.isZero(0.0))
    for (Eigen::Index i = 0; i < path.cols(); ++i)
      path.col(i) += motion.rotation[static_cast<std::size_t>(i)] * numbers.marker;
  if (numbers.insertion != 0.0)
    for (Eigen::Index i = 0; i < path.cols(); ++i)
      path.col(i) += numbers.insertion * motion.path.col(i).normalized();
}

/// First-order lag, exact for a path that is linear between its stamps.
void follow(double time_constant, const std::vector<double>& t, Eigen::Matrix3Xd& path) {
  if (!(time_constant > 0.0)) return;
  Eigen::Vector3d behind = Eigen::Vector3d::Zero(), last = path.col(0);
  for (Eigen::Index i = 1; i < path.cols(); ++i) {
    const double step = t[static_cast<std::size_t>(i)] - t[static_cast<std::size_t>(i - 1)];
    const double decay = std::exp(-step / time_constant);
    const Eigen::Vector3d now = path.col(i), rate = (now - last) / step;
    behind = decay * behind + (1.0 - decay) * time_constant * rate;
    path.col(i) = now - behind;
    last = now;
  }
}

void play(const Eigen::Vector3d& gap, Eigen::Matrix3Xd& path) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(gap[axis] > 0.0)) continue;
    double out = path(axis, 0);
    for (Eigen::Index i = 0; i < path.cols(); ++i) {
      out = std::clamp(out, path(axis, i) - gap[axis], path(axis, i) + gap[axis]);
      path(axis, i) = out;
    }
  }
}

}  // namespace

std::vector<PoseMotion> motionsOf(const PoseEvidence& evidence, PoseReference reference) {
  std::vector<PoseMotion> motions;
  for (const PoseTrajectory& trajectory : evidence.trajectories) {
    const auto& path = reference == PoseReference::kKinematics ? trajectory.robot : trajectory.command;
    if (path.size() < 2) continue;
    PoseMotion motion = motionOf(trajectory, path);
    if (!motion.t_seen.empty()) motions.push_back(std::move(motion));
  }
  if (motions.size() < kFewestMotions) {
    const bool kinematics = reference == PoseReference::kKinematics;
    throw base::InputError(
        {evidence.file,
         0,
         kinematics ? "robot" : "cmd",
         {},
         fmt::format("{} trajectories can be compared and {} are needed", motions.size(), kFewestMotions),
         kinematics ? "Record more motions with camera and forward kinematics"
                    : "Record more motions with camera and command"});
  }
  return motions;
}

Eigen::Matrix3Xd seenBy(const PoseNumbers& numbers, const PoseMotion& motion) {
  Eigen::Matrix3Xd path = motion.path;
  moveTool(numbers, motion, path);
  follow(numbers.time_constant, motion.t, path);
  play(numbers.gap, path);
  Eigen::Matrix3Xd observed(3, motion.observed.cols());
  const Eigen::Vector3d origin = numbers.camera.measure(Eigen::Vector3d::Zero());
  Eigen::Matrix3d rotated;  // the measurement of a point is linear plus the offset
  for (int axis = 0; axis < 3; ++axis)
    rotated.col(axis) = numbers.camera.measure(Eigen::Vector3d::Unit(axis)) - origin;
  std::size_t after = 1;
  for (std::size_t i = 0; i < motion.t_seen.size(); ++i) {
    const double t = std::clamp(motion.t_seen[i] - numbers.camera.delay, motion.t.front(), motion.t.back());
    while (after + 1 < motion.t.size() && motion.t[after] < t) ++after;
    const double share = (t - motion.t[after - 1]) / (motion.t[after] - motion.t[after - 1]);
    const auto k = static_cast<Eigen::Index>(after);
    const Eigen::Vector3d at = (1.0 - share) * path.col(k - 1) + share * path.col(k);
    observed.col(static_cast<Eigen::Index>(i)) = rotated * at + origin;
  }
  return observed;
}

}  // namespace capstan::diagnosis
