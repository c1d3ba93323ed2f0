#include "core/learning/model/command_correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/learning/poses/stencil.h"

namespace capstan::learning {
namespace {

void check(const std::vector<Waypoint>& waypoints) {
  if (waypoints.size() < 2)
    throw base::InputError({{},
                            0,
                            "waypoints",
                            fmt::format("{}", waypoints.size()),
                            "are too few for a motion",
                            "Give two at least"});
  for (std::size_t k = 1; k < waypoints.size(); ++k)
    if (!(waypoints[k].t > waypoints[k - 1].t))
      throw base::InputError({{},
                              0,
                              fmt::format("waypoints[{}].t", k),
                              fmt::format("{} s", waypoints[k].t),
                              fmt::format("does not come after the {} s before", waypoints[k - 1].t),
                              "Give waypoints in the order of their times"});
}

/// Share of the path covered at each waypoint, by length, or by time for a path of length 0.
std::vector<double> sharesOf(const std::vector<Waypoint>& waypoints) {
  std::vector<double> shares = {0.0};
  for (std::size_t k = 1; k < waypoints.size(); ++k)
    shares.push_back(shares.back() +
                     std::sqrt(squaredDistance(waypoints[k - 1].pose, waypoints[k].pose, kLever)));
  const double whole = shares.back();
  const double begin = waypoints.front().t, lasts = waypoints.back().t - begin;
  for (std::size_t k = 0; k < shares.size(); ++k)
    shares[k] = whole > 0.0 ? shares[k] / whole : (waypoints[k].t - begin) / lasts;
  return shares;
}

/// States of the planned path like those of an observed path: with velocities and motion history.
std::vector<State> plannedStates(const std::vector<Waypoint>& waypoints) {
  std::vector<StampedPose> path;
  for (const Waypoint& waypoint : waypoints) {
    StampedPose stamped;
    stamped.t = waypoint.t;
    stamped.pose = waypoint.pose;
    path.push_back(stamped);
  }
  return statesAlong(path);
}

class PathCorrection {
 public:
  PathCorrection(const CorrectionModel& model, const std::vector<Waypoint>& waypoints,
                 const CommandCorrectionOptions& options)
      : model_(model), waypoints_(waypoints), options_(options), states_(plannedStates(waypoints)) {}

  /// Corrected waypoint k.
  CorrectedWaypoint at(std::size_t k) const {
    const Waypoint& waypoint = waypoints_[k];
    if (options_.mode == CorrectionMode::kNone) return asked(k, waypoint.pose, 1.0);
    const Corrected corrected = model_.correct(states_[k]);
    return asked(k, corrected.pose, corrected.confidence);
  }

  /// Waypoint k with the command `pose`, reduced to the robot's reach.
  CorrectedWaypoint asked(std::size_t k, const Eigen::Isometry3d& pose, double confidence) const {
    const Waypoint& waypoint = waypoints_[k];
    const Eigen::Isometry3d rigid =
        options_.mode == CorrectionMode::kNone ? waypoint.pose : model_.offset() * waypoint.pose;
    const WithinReach reached = withinReach(pose, rigid, waypoint.pose, options_.reachable);
    return {waypoint.t, waypoint.pose, reached.pose, confidence, reached.limit};
  }

  CorrectedWaypoint first() const {
    CorrectedWaypoint first = at(0);
    if (!options_.from) return first;
    first.command = *options_.from;
    first.limit = ReachLimit::kNone;
    return first;
  }

 private:
  const CorrectionModel& model_;
  const std::vector<Waypoint>& waypoints_;
  const CommandCorrectionOptions& options_;
  std::vector<State> states_;
};

}  // namespace

std::vector<Vector6d> plannedVelocities(const std::vector<Waypoint>& waypoints) {
  std::vector<double> t;
  std::vector<Eigen::Quaterniond> turns;
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(waypoints.size()));
  for (const Waypoint& waypoint : waypoints) {
    positions.col(static_cast<Eigen::Index>(t.size())) = waypoint.pose.translation();
    t.push_back(waypoint.t);
    turns.emplace_back(waypoint.pose.linear());
  }
  const Eigen::Matrix3Xd v = velocitiesOf(t, positions), w = angularVelocitiesOf(t, turns);
  std::vector<Vector6d> velocities(waypoints.size());
  for (std::size_t k = 0; k < waypoints.size(); ++k)
    velocities[k] << v.col(static_cast<Eigen::Index>(k)), w.col(static_cast<Eigen::Index>(k));
  return velocities;
}

std::vector<CorrectedWaypoint> correctedPath(const CorrectionModel& model,
                                             const std::vector<Waypoint>& waypoints,
                                             const CommandCorrectionOptions& options) {
  check(waypoints);
  const PathCorrection correction(model, waypoints, options);
  std::vector<CorrectedWaypoint> path = {correction.first()};
  if (options.mode != CorrectionMode::kEndPoint) {
    for (std::size_t k = 1; k < waypoints.size(); ++k) path.push_back(correction.at(k));
    return path;
  }
  const std::vector<double> shares = sharesOf(waypoints);
  const CorrectedWaypoint begin = path.front(), end = correction.at(waypoints.size() - 1);
  const double confidence = std::min(begin.confidence, end.confidence);
  for (std::size_t k = 1; k + 1 < waypoints.size(); ++k)
    path.push_back(correction.asked(k, poseBetween(begin.command, end.command, shares[k]), confidence));
  path.push_back(end);
  return path;
}

bool withinReach(const std::vector<CorrectedWaypoint>& path) {
  return std::ranges::none_of(
      path, [](const CorrectedWaypoint& waypoint) { return waypoint.limit == ReachLimit::kNowhere; });
}

}  // namespace capstan::learning
