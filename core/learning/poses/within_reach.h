#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "core/base/names.h"

/// Reduction of corrections to the reach of a robot.
namespace capstan::learning {

/// Test whether a robot can be commanded to a pose, in the frame of its commands. It depends on joint limits,
/// which learning does not model. Unset: every pose can be commanded.
using Reachable = std::function<bool(const Eigen::Isometry3d&)>;

/// Part of a correction that was reduced so that the pose can be commanded.
enum class ReachLimit {
  kNone,        ///< nothing: the corrected pose can be commanded
  kCorrection,  ///< part of the learned correction is omitted; the rigid offset is complete
  kOffset,      ///< all of the correction and part of the offset are omitted
  kNowhere,     ///< not even the desired pose can be commanded
};

struct WithinReach {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  ReachLimit limit = ReachLimit::kNone;
  double share = 1.0;  ///< remaining share of the reduced part, 0…1
};

/// Pose at a `share` of the path between two poses: positions on a line, rotations along the shorter arc.
Eigen::Isometry3d poseBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double share);

/// Returns `corrected` if it can be commanded. Otherwise returns the last pose that can be commanded on the
/// path from `rigid` (the desired pose with the rigid offset alone) to `corrected`. If `rigid` cannot be
/// commanded either, the path is that from `desired` to `rigid`. If no pose can be commanded, returns
/// `desired` with kNowhere. The path is bisected kHalvings times, and `reachable` is true for every returned
/// pose except with kNowhere. All poses are in the frame of the robot's commands.
WithinReach withinReach(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& rigid,
                        const Eigen::Isometry3d& desired, const Reachable& reachable);
inline constexpr int kHalvings = 20;

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::ReachLimit> {
  using L = capstan::learning::ReachLimit;
  static constexpr std::array value = {
      std::pair{L::kNone, "as learned"}, std::pair{L::kCorrection, "part of the correction"},
      std::pair{L::kOffset, "part of the offset"}, std::pair{L::kNowhere, "out of reach"}};
};
