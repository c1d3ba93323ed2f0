#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/diagnosis/evidence/pose_evidence.h"
#include "core/robot/chain/chain_model.h"

namespace capstan::diagnosis {

/// What the cameras are compared with.
enum class PoseReference {
  kKinematics,  ///< what the robot computed from its motors
  kCommand,     ///< what it was commanded
};

/// A path that a simulation says and the observations to compare it with, of one trajectory.
struct PoseMotion {
  std::string name;
  std::vector<double> t;  ///< of the path, rising [s]
  Eigen::Matrix3Xd path;  ///< [m]
  std::vector<Eigen::Quaterniond> rotation;
  std::vector<double> t_seen;  ///< of the observations, rising [s]
  Eigen::Matrix3Xd observed;   ///< [m]
};

/// Observations that count, later than kBefore after the path's begin (a delay reaches back), before its end,
/// and not where the path has a gap longer than kLongestGap. Trajectories without any are excluded.
/// base::InputError: the table has no such poses, or fewer than kFewestMotions trajectories are left.
std::vector<PoseMotion> motionsOf(const PoseEvidence& evidence, PoseReference reference);
inline constexpr double kBefore = 0.2, kLongestGap = 0.1;  ///< [s]
inline constexpr std::size_t kFewestMotions = 20;

/// Between a path and what cameras see of it; all zero: they see the path.
struct PoseNumbers {
  robot::CameraNumbers camera;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< in the tool's frame [m]
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();     ///< half width of the play along each axis [m]
  double insertion = 0.0;     ///< along the line from the remote centre, frame 0's origin [m]
  double clock_offset = 0.0;  ///< time constant with which the tip follows [s]
};

/// What cameras should see at the observations, 3 × observations: the path p with its tool's turn R_t becomes
///     a = p + R_t marker + insertion p / |p|,
///     b: lag ḃ = a − b, b = a at the begin,
///     c: play of half width `gap` on b, axis by axis (c moves when it is half a width behind; it begins in
///        the middle),
///     d(t) = c(t − delay), linear between the path's stamps, its ends beyond it,
/// and the observation is CameraNumbers::measure(d), that is (1 + scale) R d + offset.
Eigen::Matrix3Xd seenBy(const PoseNumbers& numbers, const PoseMotion& motion);

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::PoseReference> {
  using R = capstan::diagnosis::PoseReference;
  static constexpr std::array value = {std::pair{R::kKinematics, "kinematics"},
                                       std::pair{R::kCommand, "command"}};
};
