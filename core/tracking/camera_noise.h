#pragma once

#include <Eigen/Core>

#include "core/robot/description.h"
#include "core/tracking/joint_observation.h"
#include "core/tracking/options.h"

namespace capstan::tracking {

/// Ratio of true to stated pixel noise, measured from the pixels themselves. A stereo pair measures three
/// unknowns by four numbers, so the weighted squared reprojection error of the triangulated point is
/// chi-square distributed with one degree of freedom if the stated σ is correct. Its mean is (true σ / stated
/// σ)², independent of robot, filter and registration.
class PixelNoise {
 public:
  /// Averages over about `memory` pairs; 0: the stated noise is used. The stated noise counts as kPrior
  /// pairs.
  explicit PixelNoise(int memory) : memory_(memory) {}

  void reset() { ratio_ = 1.0, seen_ = 0; }
  /// Adds vision::Triangulation::chi_square of one pair under the stated noise. It is limited to kOutlier
  /// times its expected value.
  void add(double chi_square);
  /// True variance divided by stated variance.
  double ratio() const { return ratio_; }

  static constexpr int kPrior = 30;
  static constexpr double kOutlier = 9.0;

 private:
  int memory_;
  int seen_ = 0;
  double ratio_ = 1.0;
};

/// Covariance R of the error of q_cam [rad, rad, m], computed from the sources of error:
///     Sigma_p = ratio · Sigma_pixels + shift² I + turn² (|d|² I − d dᵀ),   d = p − p_hs
///     R = J⁻¹ Sigma_p J⁻ᵀ + clock² dq dqᵀ + diag(floor²)
/// Sigma_pixels is the markers' pixel noise, propagated through triangulation (σ of the depth: z² / (f b)
/// times σ of the disparity). The registration has the standard deviation `shift` in the marker's position at
/// the hard stop p_hs along each axis (sag that kinematics does not include), and `turn` in the cameras'
/// rotation about each axis. The time stamp has the standard deviation `clock` while joints move at dq.
/// Registration errors are constant, but R models them as independent noise. That is acceptable because the
/// cable model forgets a camera update with time constant b_e / k_e, less than a frame period: the filter
/// never averages these errors down.
///
/// With camera_noise: constant, R = diag(constant_camera_sigma²), as in the UKF paper.
class CameraNoise {
 public:
  CameraNoise(const robot::Description& robot, const TrackingOptions& options);

  void reset() { pixels_.reset(); }
  PixelNoise& pixels() { return pixels_; }

  /// Sigma_p of a tip in frame 0 [m²]; `pixels` is the covariance from triangulation, in frame 0.
  Eigen::Matrix3d ofImagedTip(const Eigen::Vector3d& tip, const Eigen::Matrix3d& pixels) const;
  /// Sigma_p of a tip that another system measured [m²]: tip_sigma² in place of ratio · Sigma_pixels.
  Eigen::Matrix3d ofTip(const Eigen::Vector3d& tip) const;
  /// R of `seen`, whose covariance is J⁻¹ Sigma_p J⁻ᵀ; the joints move at `speed` [rad/s, rad/s, m/s], and
  /// time stamps have the standard deviation `clock` [s].
  Eigen::Matrix3d ofJoints(const JointObservation& seen, const Eigen::Vector3d& speed, double clock) const;

 private:
  Eigen::Matrix3d ofRegistration(const Eigen::Vector3d& tip) const;

  TrackingOptions options_;
  Eigen::Vector3d hard_stop_;  ///< marker at the hard stop, frame 0 [m]
  PixelNoise pixels_;
};

}  // namespace capstan::tracking
