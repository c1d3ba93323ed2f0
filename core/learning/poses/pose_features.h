#pragma once

#include "core/base/names.h"
#include "core/learning/poses/states.h"

/// Poses and velocities as input features and outputs of a process.
namespace capstan::learning {

enum class RotationForm {
  kTangent,  ///< rotation vectors: for features relative to a mean rotation, for corrections in the tool's
             ///< frame
  kYawPitchRoll,  ///< as in the paper: R = R_z(yaw) R_y(pitch) R_x(roll), each angle separately
};

/// Motion features of a process besides the pose.
enum class Motion {
  kNone,
  kVelocity,  ///< as in the paper
  kHistory,   ///< in addition the mean velocities of the last kSpans
};

/// Angles of R = R_z(yaw) R_y(pitch) R_x(roll) [rad], pitch in ±π/2, the others in ±π. At a pitch of ±π/2,
/// roll is 0.
Eigen::Vector3d yawPitchRoll(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d fromYawPitchRoll(const Eigen::Vector3d& angles);

/// Mean rotation (Markley, Averaging quaternions, 2007): identity for an empty set.
Eigen::Quaterniond meanRotation(const std::vector<Eigen::Isometry3d>& poses);

class PoseFeatures {
 public:
  /// Features of poses around the rotation `middle`.
  PoseFeatures(RotationForm form, Motion motion, const Eigen::Quaterniond& middle);

  Eigen::Index size() const;
  /// Features of `observed`, multiplied by `offset` on the left: position [m], rotation [rad], velocity
  /// [m/s], rotation rate [rad/s], and the mean velocities of each of kSpans.
  Eigen::RowVectorXd of(const Eigen::Isometry3d& offset, const State& observed) const;
  /// Difference from `from` to `to`: position [m], rotation [rad].
  Vector6d correction(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  /// Pose `from` after a correction.
  Eigen::Isometry3d corrected(const Eigen::Isometry3d& from, const Vector6d& correction) const;

  RotationForm form() const { return form_; }
  Motion motion() const { return motion_; }
  const Eigen::Quaterniond& middle() const { return middle_; }

 private:
  RotationForm form_;
  Motion motion_;
  Eigen::Quaterniond middle_;
};

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::RotationForm> {
  using F = capstan::learning::RotationForm;
  static constexpr std::array value = {std::pair{F::kTangent, "tangent"},
                                       std::pair{F::kYawPitchRoll, "yaw_pitch_roll"}};
};

template <>
struct capstan::base::NamesOf<capstan::learning::Motion> {
  using M = capstan::learning::Motion;
  static constexpr std::array value = {std::pair{M::kNone, "none"}, std::pair{M::kVelocity, "velocity"},
                                       std::pair{M::kHistory, "history"}};
};
