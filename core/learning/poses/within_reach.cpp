#include "core/learning/poses/within_reach.h"

namespace capstan::learning {
namespace {

/// Largest share of the path between two poses that can be commanded; the first pose can be.
WithinReach farthest(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, ReachLimit limit,
                     const Reachable& reachable) {
  WithinReach found{from, limit, 0.0};
  double beyond = 1.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double share = 0.5 * (found.share + beyond);
    const Eigen::Isometry3d pose = poseBetween(from, to, share);
    if (reachable(pose)) {
      found.pose = pose;
      found.share = share;
    } else {
      beyond = share;
    }
  }
  return found;
}

}  // namespace

Eigen::Isometry3d poseBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double share) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(from.linear())
                      .slerp(share, Eigen::Quaterniond(to.linear()))
                      .normalized()
                      .toRotationMatrix();
  pose.translation() = (1.0 - share) * from.translation() + share * to.translation();
  return pose;
}

WithinReach withinReach(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& rigid,
                        const Eigen::Isometry3d& desired, const Reachable& reachable) {
  if (!reachable || reachable(corrected)) return {corrected, ReachLimit::kNone, 1.0};
  if (reachable(rigid)) return farthest(rigid, corrected, ReachLimit::kCorrection, reachable);
  if (reachable(desired)) return farthest(desired, rigid, ReachLimit::kOffset, reachable);
  return {desired, ReachLimit::kNowhere, 0.0};
}

}  // namespace capstan::learning
