#pragma once

#include <optional>
#include <vector>

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/within_reach.h"

/// Paths through F = H ∘ G (GPR paper, sections V-C and V-D): the command along a planned motion, so that
/// cameras see that motion.
namespace capstan::learning {

/// Where a motion is to be at a time.
struct Waypoint {
  double t = 0.0;                                          ///< [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< as cameras see it
};

enum class CorrectionMode {
  kNone,      ///< the desired pose is commanded
  kEndPoint,  ///< of a straight motion its first and last pose are corrected, the way between is straight
  kFullTrajectory,  ///< each waypoint is corrected with its planned velocity
};
inline constexpr std::size_t kCorrectionModes = 3;

struct CommandCorrectionOptions {
  CorrectionMode mode = CorrectionMode::kFullTrajectory;
  Reachable reachable;                    ///< of commands
  std::optional<Eigen::Isometry3d> from;  ///< last commanded pose: commands begin there, without a jump
};

struct CorrectedWaypoint {
  double t = 0.0;                                             ///< [s]
  Eigen::Isometry3d desired = Eigen::Isometry3d::Identity();  ///< in the cameras' frame
  Eigen::Isometry3d command = Eigen::Isometry3d::Identity();  ///< in the robot's
  double confidence = 1.0;  ///< Corrected::confidence; 1 without a correction
  ReachLimit limit = ReachLimit::kNone;
};

/// Planned velocity at each waypoint, [m/s] and [rad/s] in the tool's own frame: the five-point stencil, as
/// of the states that a model is learned from, so that a motion that ends on the move has its speed at its
/// last waypoint too.
std::vector<Vector6d> plannedVelocities(const std::vector<Waypoint>& waypoints);

/// The command at the time of each waypoint. Along an end-point path the command covers, at each
/// waypoint, the share of its way that is planned to be behind (lengths with turns by the lever), with the
/// lesser confidence of both ends. Every command is within reach, or
/// said to be kNowhere (within_reach.h): a robot must not be moved along a path with such a waypoint.
/// base::InputError: fewer than two waypoints, or times that do not rise.
std::vector<CorrectedWaypoint> correctedPath(const CorrectionModel& model,
                                             const std::vector<Waypoint>& waypoints,
                                             const CommandCorrectionOptions& options);

/// Is there a command for every waypoint?
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
