#pragma once

#include <Eigen/Core>

#include "core/robot/description.h"
#include "core/tracking/joint_observation.h"
#include "core/tracking/options.h"

namespace capstan::tracking {

/// How much the pixels' stated noise is off, measured from the pixels themselves: a stereo pair sees three
/// unknowns in four numbers, and the weighted squared reprojection error of the point between them is
/// chi-square with one degree of freedom when the stated σ is right. Its mean is (true σ / stated σ)²,
/// whatever robot, filter and registration make of the point.
class PixelNoise {
 public:
  /// Remembers about `memory` pairs; 0: the stated noise is used. The stated one counts as kPrior pairs.
  explicit PixelNoise(int memory) : memory_(memory) {}

  void reset() { ratio_ = 1.0, seen_ = 0; }
  /// One more pair's vision::Triangulation::chi_square, under the stated noise. Beyond kOutlier of what is
  /// expected it counts as that.
  void add(double chi_square);
  /// True variance by stated variance.
  double ratio() const { return ratio_; }

  static constexpr int kPrior = 30;
  static constexpr double kOutlier = 9.0;

 private:
  int memory_;
  int seen_ = 0;
  double ratio_ = 1.0;
};

/// R, the covariance of q_cam's error [rad, rad, m], from where errors come from:
///     Sigma_p = ratio · Sigma_pixels + shift² I + turn² (|d|² I − d dᵀ),   d = p − p_hs
///     R = J⁻¹ Sigma_p J⁻ᵀ + clock² dq dqᵀ + diag(floor²)
/// Sigma_pixels is what triangulation makes of the markers' sigma (depth: z² / (f b) times the disparity's);
/// the registration knows the marker's position at the hard stop p_hs up to `shift` along each axis (the sag
/// that kinematics does not see) and the cameras' mounting up to `turn` about each; the stamp is off by
/// `clock` while joints move at dq. Registration errors are constant, but R models them as independent noise.
/// That is acceptable because the cable model forgets a camera update with time constant b_e / k_e, less than
/// a frame period: the filter never averages these errors down.
///
/// With camera_noise: constant, R = diag(constant_camera_sigma²), as in the UKF paper.
class CameraNoise {
 public:
  CameraNoise(const robot::Description& robot, const TrackingOptions& options);

  void reset() { pixels_.reset(); }
  PixelNoise& pixels() { return pixels_; }

  /// Sigma_p of a tip in frame 0 [m²]; `pixels` as triangulated, in frame 0.
  Eigen::Matrix3d ofImagedTip(const Eigen::Vector3d& tip, const Eigen::Matrix3d& pixels) const;
  /// Sigma_p of a tip that another system measured: tip_sigma in place of the pixels.
  Eigen::Matrix3d ofTip(const Eigen::Vector3d& tip) const;
  /// R; `seen` with J⁻¹ Sigma_p J⁻ᵀ, joints moving at `speed` [rad/s, rad/s, m/s].
  Eigen::Matrix3d ofJoints(const JointObservation& seen, const Eigen::Vector3d& speed) const;

 private:
  Eigen::Matrix3d ofRegistration(const Eigen::Vector3d& tip) const;

  TrackingOptions options_;
  Eigen::Vector3d hard_stop_;  ///< marker at the hard stop, frame 0 [m]
  PixelNoise pixels_;
};

}  // namespace capstan::tracking
