#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/camera_pose.h"
#include "core/identification/shooting.h"
#include "core/robot/arm_kinematics.h"

namespace capstan::identification {

/// Whitened residuals of the observations (in standard deviations) as a function of all unknowns.
///
/// The unknowns x have unit prior: set.size() logarithms / their prior_sigma, then CameraPose (rotation,
/// shift, delay) / CameraPoseOptions::sigmas(). An unknown with zero prior sigma has no effect. The residual
/// of observation k, with tip covariance L Lᵀ and predictions q, dq (shooting.h), is
///     r_k = L⁻¹ ( tip_k − seen( tip(q − delay dq) ) ).
/// Tips are compared, not joints, because inverse kinematics of a noisy tip is biased: with 4 mm of depth
/// noise at 0.15 m from the remote centre, by 0.05 mm of insertion, which is as much as a cable stretches.
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

  /// Computes `residuals` (3 · observations() values) and, unless null, `jacobian` = d residuals / d x.
  /// Returns false when cancelled.
  bool evaluate(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian,
                const base::Progress* progress = nullptr);

  /// Computes them for another camera pose, with the predictions of the last evaluate(): the logarithms in x
  /// are ignored.
  void compare(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian) const;

  /// Logarithms ln(w / nominal) of x.
  ParameterSet::Logs logs(const Vector& x) const {
    return scale_.head(set_.size()).cwiseProduct(x.head(set_.size()));
  }
  CameraPose pose(const Vector& x) const;  ///< camera pose of x
  /// d r_k / d q of the last evaluate() at x: change of the residual per joint error [1/rad, 1/rad, 1/m].
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
  std::vector<Eigen::Matrix3d> whitening_;  ///< L⁻¹ per observation
  std::vector<ArmPrediction> predictions_;
};

/// Centre of CameraPose: mean of the observed tips in use.
Eigen::Vector3d centreOf(const IdentificationData& data);

}  // namespace capstan::identification
