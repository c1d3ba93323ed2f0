#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/camera_pose.h"
#include "core/identification/shooting.h"
#include "core/robot/arm_kinematics.h"

namespace capstan::identification {

/// What the observations say against the prediction, in standard deviations, as a function of all unknowns.
///
/// Unknowns x, unit prior each: set.size() logarithms by their prior_sigma, then CameraPose (turn, shift,
/// delay) by CameraPoseOptions::sigmas(); unknowns of zero prior sigma have no effect. Residual of
/// observation k, with L Lᵀ its tip covariance and q, dq predicted (shooting.h):
///     r_k = L⁻¹ ( tip_k − seen( tip(q − delay dq) ) )
/// Tips, not joints, are compared: inverse kinematics of a noisy tip is biased, at 4 mm of depth noise and
/// 0.15 m from the remote centre by 0.05 mm of insertion, as much as a cable stretches.
class OutputError {
 public:
  using Vector = Eigen::VectorXd;
  static constexpr int kMostUnknowns = kMostParameters + CameraPose::kSize;

  /// `data` and `set` must outlive it.
  OutputError(const IdentificationData& data, const ParameterSet& set, const CameraPoseOptions& pose,
              const ShootingOptions& shooting);

  int unknowns() const { return set_.size() + CameraPose::kSize; }
  int observations() const { return static_cast<int>(shooting_.used().size()); }
  const Shooting& shooting() const { return shooting_; }
  const Vector& scale() const { return scale_; }  ///< prior sigma of each unknown

  /// residuals: 3 · observations(); jacobian, unless null: d residuals / d x. False: cancelled.
  bool evaluate(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian,
                const base::Progress* progress = nullptr);

  /// The same for other poses of the camera: with the predictions of the last evaluate(), x's logarithms
  /// unread.
  void compare(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian) const;

  ParameterSet::Logs logs(const Vector& x) const {
    return scale_.head(set_.size()).cwiseProduct(x.head(set_.size()));
  }
  CameraPose pose(const Vector& x) const;
  /// d r_k / d q of the last evaluate() at x: what joints off by [rad, rad, m] would do to the residual.
  Eigen::Matrix3d residualByJoint(const Vector& x, int k) const;
  /// Predictions of the last evaluate().
  const std::vector<ArmPrediction>& predictions() const { return predictions_; }
  const CameraObservation& observation(int k) const {
    return data_.cameras[shooting_.used()[static_cast<std::size_t>(k)]];
  }

 private:
  const IdentificationData& data_;
  const ParameterSet& set_;
  Shooting shooting_;
  robot::ArmKinematics arm_;
  Vector scale_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Matrix3d> whitening_;  ///< L⁻¹ by observation
  std::vector<ArmPrediction> predictions_;
};

/// Mean of the tips seen with an open gate: the centre of CameraPose.
Eigen::Vector3d centreOf(const IdentificationData& data);

}  // namespace capstan::identification
