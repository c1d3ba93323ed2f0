#include "core/learning/poses/screen_poses.h"

#include <algorithm>
#include <cmath>

namespace capstan::learning {
namespace {

Reason judged(const RawPose& raw, const std::vector<StampedPose>& before) {
  if (!std::isfinite(raw.t) || !raw.position.allFinite() || !raw.quaternion.allFinite())
    return Reason::kNotFinite;
  if (raw.position.isZero(0.0) && raw.quaternion.head<3>().isZero(0.0)) return Reason::kPlaceholder;
  if (std::abs(raw.quaternion.norm() - 1.0) > kNorm) return Reason::kNoRotation;
  if (before.empty() || raw.t > before.back().t) return Reason::kNone;
  return raw.t == before.back().t ? Reason::kRepeat : Reason::kBackInTime;
}

StampedPose poseOf(const RawPose& raw) {
  StampedPose stamped{raw.row, raw.t, Eigen::Isometry3d::Identity()};
  stamped.pose.linear() = Eigen::Quaterniond(raw.quaternion).normalized().toRotationMatrix();
  stamped.pose.translation() = raw.position;
  return stamped;
}

}  // namespace

std::size_t ScreenReport::count(StreamKind stream, Reason reason) const {
  return static_cast<std::size_t>(std::count_if(rejected.begin(), rejected.end(), [&](const RejectedRow& r) {
    return r.stream == stream && r.reason == reason;
  }));
}

ScreenReport screenPoses(std::span<const RawMotion> motions) {
  ScreenReport report;
  for (std::size_t m = 0; m < motions.size(); ++m) {
    PoseMotion motion{motions[m].name, {}, motions[m].table};
    for (std::size_t s = 0; s < kStreams; ++s) {
      std::vector<StampedPose>& poses = motion.streams[s];
      for (const RawPose& raw : motions[m].streams[s]) {
        const Reason reason = judged(raw, poses);
        if (reason == Reason::kNone)
          poses.push_back(poseOf(raw));
        else
          report.rejected.push_back({static_cast<StreamKind>(s), m, raw.row, reason});
      }
      report.rows[s] += motions[m].streams[s].size();
      report.poses[s] += poses.size();
    }
    report.motions.push_back(std::move(motion));
  }
  return report;
}

}  // namespace capstan::learning
