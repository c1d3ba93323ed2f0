#pragma once

#include <optional>
#include <vector>

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/within_reach.h"

/// Corrected paths (GPR paper, sections V-C and V-D): commands along a planned motion by F = H ∘ G, so that
/// the motion observed by the cameras is the planned one.
namespace capstan::learning {

/// Desired pose of a motion at a time.
struct Waypoint {
  double t = 0.0;                                          ///< [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in the cameras' frame
};

enum class CorrectionMode {
  kNone,            ///< the desired pose is commanded
  kEndPoint,        ///< only the first and last pose of a straight motion are corrected, with a straight path
                    ///< between them
  kFullTrajectory,  ///< each waypoint is corrected with its planned velocity
};
inline constexpr std::size_t kCorrectionModes = 3;

struct CommandCorrectionOptions {
  CorrectionMode mode = CorrectionMode::kFullTrajectory;
  Reachable reachable;                    ///< which commands are within reach
  std::optional<Eigen::Isometry3d> from;  ///< last commanded pose, at which commands begin without a jump
};

struct CorrectedWaypoint {
  double t = 0.0;                                             ///< [s]
  Eigen::Isometry3d desired = Eigen::Isometry3d::Identity();  ///< in the cameras' frame
  Eigen::Isometry3d command = Eigen::Isometry3d::Identity();  ///< in the robot's frame
  double confidence = 1.0;  ///< Corrected::confidence; 1 without a correction
  ReachLimit limit = ReachLimit::kNone;
};

/// Planned velocity at each waypoint, [m/s] and [rad/s] in the tool's own frame, by the five-point stencil
/// like the training states of a model. A motion that does not end at rest therefore has its speed at the
/// last waypoint too.
std::vector<Vector6d> plannedVelocities(const std::vector<Waypoint>& waypoints);

/// Command at the time of each waypoint. With kEndPoint, the command at each waypoint has covered the same
/// share of its path as the planned motion (length of translation and rotation, by the lever), and its
/// confidence is the lower one of both ends. A command is within reach or marked kNowhere (within_reach.h); a
/// robot must not be moved along a path with such a waypoint. Throws base::InputError for fewer than two
/// waypoints, or times that do not increase.
std::vector<CorrectedWaypoint> correctedPath(const CorrectionModel& model,
                                             const std::vector<Waypoint>& waypoints,
                                             const CommandCorrectionOptions& options);

/// True if there is a command for every waypoint.
bool withinReach(const std::vector<CorrectedWaypoint>& path);

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::CorrectionMode> {
  using M = capstan::learning::CorrectionMode;
  static constexpr std::array value = {std::pair{M::kNone, "no correction"},
                                       std::pair{M::kEndPoint, "end point"},
                                       std::pair{M::kFullTrajectory, "full trajectory"}};
};

template <>
struct capstan::base::KeysOf<capstan::learning::CorrectionMode> {
  using M = capstan::learning::CorrectionMode;
  static constexpr std::array value = {std::pair{M::kNone, "none"}, std::pair{M::kEndPoint, "end_point"},
                                       std::pair{M::kFullTrajectory, "full_trajectory"}};
};
