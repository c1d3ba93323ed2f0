#include "core/experiments/tool_rig.h"

#include <algorithm>
#include <cmath>

#include "core/learning/poses/pose_features.h"
#include "core/stats/quantile.h"

namespace capstan::experiments {
namespace {

constexpr double kPeriod = simulation::ToolRobot::kCommandPeriod;
constexpr double kBelongs =
    0.003;  // of the median position, within which an observation gives the rotation [m]

std::size_t ticksOf(double seconds) {
  return static_cast<std::size_t>(std::max(0L, std::lround(seconds / kPeriod)));
}

}  // namespace

ToolRig::ToolRig(const robot::Description& nominal, const simulation::ToolTruth& truth,
                 const robot::JointVector& start, std::uint64_t seed)
    : robot_(nominal, truth, start), camera_(truth.camera, seed), opening_(start[robot::kToolJoints - 1]) {}

void ToolRig::write(learning::StreamKind stream, double t, const Eigen::Isometry3d& pose) {
  std::vector<learning::RawPose>& rows = recording_->streams[static_cast<std::size_t>(stream)];
  rows.push_back(
      {rows.size() + 1, t, pose.translation(), Eigen::Quaterniond(pose.linear()).normalized().coeffs()});
}

void ToolRig::tick(const Eigen::Isometry3d& command) {
  refused_ += robot_.ask(command, opening_) ? 0 : 1;
  const double asked = robot_.time();
  robot_.advance();
  const simulation::PoseObservation observation = camera_.see(robot_.time(), robot_.arm().pose());
  if (observing_ && observation.observed) observing_->push_back(observation.pose);
  if (!recording_) return;
  write(learning::StreamKind::kCommand, asked, robot_.commanded());
  write(learning::StreamKind::kRobot, robot_.time(), robot_.nominalPose());
  write(learning::StreamKind::kCamera, observation.t, observation.pose);
}

bool ToolRig::follow(const std::vector<learning::CorrectedWaypoint>& path) {
  if (!learning::withinReach(path)) return false;
  const double begin = path.front().t;
  const std::size_t ticks = std::max<std::size_t>(ticksOf(path.back().t - begin), 1);
  std::size_t k = 1;
  for (std::size_t tick_number = 1; tick_number < ticks; ++tick_number) {
    const double t = begin + static_cast<double>(tick_number) * kPeriod;
    while (k + 1 < path.size() && path[k].t < t) ++k;
    const learning::CorrectedWaypoint &a = path[k - 1], &b = path[k];
    tick(learning::poseBetween(a.command, b.command, std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0)));
  }
  tick(path.back().command);
  return true;
}

void ToolRig::rest(double seconds) {
  for (std::size_t k = ticksOf(seconds); k > 0; --k) tick(robot_.commanded());
}

void ToolRig::moveJaws(double opening, double seconds) {
  const double from = opening_;
  const std::size_t ticks = std::max<std::size_t>(ticksOf(seconds), 1);
  for (std::size_t k = 1; k <= ticks; ++k) {
    opening_ = from + (opening - from) * static_cast<double>(k) / static_cast<double>(ticks);
    tick(robot_.commanded());
  }
}

std::optional<Eigen::Isometry3d> ToolRig::look(double seconds) {
  std::vector<Eigen::Isometry3d> observed, belong;
  observing_ = &observed;
  rest(seconds);
  observing_ = nullptr;
  if (observed.empty()) return std::nullopt;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    along.reserve(observed.size());
    for (const Eigen::Isometry3d& one : observed) along.push_back(one.translation()[axis]);
    pose.translation()[axis] = stats::median(along);
  }
  for (const Eigen::Isometry3d& one : observed)
    if ((one.translation() - pose.translation()).norm() < kBelongs) belong.push_back(one);
  pose.linear() = learning::meanRotation(belong.empty() ? observed : belong).toRotationMatrix();
  return pose;
}

learning::Reachable ToolRig::reachable() const {
  return [this](const Eigen::Isometry3d& pose) { return robot_.canTake(pose, opening_); };
}

}  // namespace capstan::experiments
