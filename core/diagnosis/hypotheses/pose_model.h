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

/// Reference that the observed poses are compared with.
enum class PoseReference {
  kKinematics,  ///< forward kinematics of the robot
  kCommand,     ///< commanded poses
};

/// Reference path of one trajectory, and the observations that are compared with it.
struct PoseMotion {
  std::string name;
  std::vector<double> t;  ///< times of the path, rising [s]
  Eigen::Matrix3Xd path;  ///< positions of the path [m]
  std::vector<Eigen::Quaterniond> rotation;
  std::vector<double> t_seen;  ///< times of the observations, rising [s]
  Eigen::Matrix3Xd observed;   ///< observed positions [m]
};

/// Motions of all trajectories with observations. Observations are used if they are no outliers (`counts`),
/// lie at least kBefore after the start of the path (a delay refers to earlier poses) and before its end, and
/// are not in a gap of the path longer than kLongestGap. Throws base::InputError with fewer than
/// kFewestMotions motions.
std::vector<PoseMotion> motionsOf(const PoseEvidence& evidence, PoseReference reference);
inline constexpr double kBefore = 0.2, kLongestGap = 0.1;  ///< [s]
inline constexpr std::size_t kFewestMotions = 20;

/// Parameters between a path and the camera measurements of it; if all are zero, the cameras measure the
/// path.
struct PoseNumbers {
  robot::CameraNumbers camera;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< marker position in the tool's frame [m]
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();     ///< half width of the play along each axis [m]
  double insertion = 0.0;      ///< shift along the line from the remote centre (origin of frame 0) [m]
  double time_constant = 0.0;  ///< time constant of the first-order lag of the tip [s]
};

/// Simulated camera measurements at the times of the observations, 3 × observations [m]. The path p with the
/// tool's rotation R_t becomes
///     a = p + R_t marker + insertion p / |p|,
///     b: time_constant ḃ = a − b, b = a at the start,
///     c: play of half width `gap` on b, axis by axis (c follows b where they differ by more than `gap`, and
///        stays `gap` behind; it starts in the middle of the play),
///     d(t) = c(t − camera.delay), linear between the path's stamps, and constant beyond its ends.
/// The observation is CameraNumbers::measure(d), that is (1 + scale) R d + offset.
Eigen::Matrix3Xd seenBy(const PoseNumbers& numbers, const PoseMotion& motion);

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::PoseReference> {
  using R = capstan::diagnosis::PoseReference;
  static constexpr std::array value = {std::pair{R::kKinematics, "kinematics"},
                                       std::pair{R::kCommand, "command"}};
};
