#pragma once

#include "core/base/names.h"
#include "core/learning/states.h"

/// Poses and velocities as the numbers that a process learns from and of.
namespace capstan::learning {

enum class RotationForm {
  kTangent,       ///< rotation vectors: of features from a middle turn, of corrections in the tool's frame
  kYawPitchRoll,  ///< the paper's: R = R_z(yaw) R_y(pitch) R_x(roll), each angle alone
};

/// Angles of R = R_z(yaw) R_y(pitch) R_x(roll) [rad], pitch in ±π/2, the others in ±π; where the pitch is
/// ±π/2, roll is 0.
Eigen::Vector3d yawPitchRoll(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d fromYawPitchRoll(const Eigen::Vector3d& angles);

/// The turn in the middle of some (Markley, Averaging quaternions, 2007): identity of none.
Eigen::Quaterniond middleTurn(const std::vector<Eigen::Isometry3d>& poses);

class PoseFeatures {
 public:
  /// Of poses around `middle`; with velocities 12 features, without 6.
  PoseFeatures(RotationForm form, bool velocity, const Eigen::Quaterniond& middle);

  Eigen::Index size() const { return velocity_ ? 12 : 6; }
  /// [position [m], turn [rad], velocity [m/s], turn rate [rad/s]]
  Eigen::RowVectorXd of(const Eigen::Isometry3d& pose, const Vector6d& velocity) const;
  /// What takes `from` to `to`: [position [m], turn [rad]].
  Vector6d correction(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  /// The pose that a correction leads to.
  Eigen::Isometry3d corrected(const Eigen::Isometry3d& from, const Vector6d& correction) const;

  RotationForm form() const { return form_; }
  bool velocity() const { return velocity_; }
  const Eigen::Quaterniond& middle() const { return middle_; }

 private:
  RotationForm form_;
  bool velocity_;
  Eigen::Quaterniond middle_;
};

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::RotationForm> {
  using F = capstan::learning::RotationForm;
  static constexpr std::array value = {std::pair{F::kTangent, "tangent"},
                                       std::pair{F::kYawPitchRoll, "yaw_pitch_roll"}};
};
