#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "core/base/names.h"

/// Corrections that ask for no more than a robot can do.
namespace capstan::learning {

/// Whether a robot can be commanded to a pose, in the frame of its commands: joint limits, in the end, which
/// learning does not know. Unset: every pose can be commanded.
using Reachable = std::function<bool(const Eigen::Isometry3d&)>;

/// What a pose was shrunk towards, so that it can be commanded.
enum class ReachLimit {
  kNone,        ///< nothing: it can be commanded as it is
  kCorrection,  ///< the rigid offset: part of the learned correction is omitted
  kOffset,      ///< the desired pose: all of the correction and part of the offset are omitted
  kNowhere,     ///< not even the desired pose can be commanded
};

struct WithinReach {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  ReachLimit limit = ReachLimit::kNone;
  double share = 1.0;  ///< that is left of what was shrunk, 0…1
};

/// The pose a `share` of the way from one to the other: positions in line, turns along the shorter arc.
Eigen::Isometry3d poseBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double share);

/// `corrected` where it can be commanded; else the last pose that can on the way to it from `rigid`, the
/// desired pose under the rigid offset alone; else on the way to `rigid` from `desired`; else `desired`,
/// which must not be commanded then. The way is halved kHalvings times, and no pose is given that `reachable`
/// was not asked about. All in the frame of the robot's commands.
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
