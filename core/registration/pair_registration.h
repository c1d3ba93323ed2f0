#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "core/base/names.h"
#include "core/base/result.h"

namespace capstan::registration {

/// Reason why pairs of points do not determine base_from_camera.
enum class PairFault { kTooFewPairs, kCollinear, kMirrored, kScale, kNoAgreement, kScatter, kTooClose };

/// One point in both frames [m].
struct PointPair {
  Eigen::Vector3d camera, base;
};

struct PairRefusal {
  PairFault fault = PairFault::kTooFewPairs;
  double value = 0.0;  ///< kScale: length in the base frame over length in the camera frame; kScatter:
                       ///< standard deviation of a pair per axis [m]; kTooClose: standard deviation of the
                       ///< rotation [rad]; else pairs used
};

struct PairRegistration {
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  /// Covariance of (rotation vector [rad], translation [m]), both in base axes, 6 × 6. The true transform is
  /// p = exp(θ) R c + t + δt for a point c in the camera frame. From the covariance of the residuals in
  /// camera axes, because cameras measure depth worse than the other two.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double sigma = 0.0;              ///< standard deviation of a pair per axis [m]
  double rms = 0.0;                ///< RMS distance of the pairs used [m]
  double leave_one_out_rms = 0.0;  ///< RMS distance of each pair used from the fit of the others [m]
  std::vector<double> residuals;   ///< distance of every pair from the fit [m]
  std::vector<bool> used;          ///< false: rejected as an outlier
  /// Largest displacement, at any pair used, of the fit without this pair [m]; 0 for a rejected pair.
  std::vector<double> shifts;
};

/// Computes base_from_camera from the same points in both frames [m] by least squares (Kabsch 1976) over the
/// pairs that agree. The start is the least trimmed squares fit of random triples (Rousseeuw & Van Driessen
/// 2006). A pair is rejected where its squared distance exceeds what normal errors give once in a hundred
/// sets (F distribution, Bonferroni). At least four pairs. Refuses points on one line, frames of unequal
/// handedness, lengths whose ratio is outside 1 ± 0.03, sets in which half of the pairs or fewer agree, pairs
/// that scatter by more than 0.3 of the points' own spread, and points so close together that the rotation is
/// uncertain by more than 3°.
base::Result<PairRegistration, PairRefusal> registerPairs(std::span<const PointPair> pairs);

/// Standard deviation of the transformed point `camera` [m]: the root of the trace of its covariance [m].
double sigmaAt(const PairRegistration& registration, const Eigen::Vector3d& camera);

/// Error of the transformed point `camera` that at least 95 % of registrations like this one do not exceed
/// [m]: sigmaAt times the 95 % quantile of |Student's t| with the degrees of freedom of one axis, because the
/// error may lie along the depth alone.
double error95At(const PairRegistration& registration, const Eigen::Vector3d& camera);

}  // namespace capstan::registration

template <>
struct capstan::base::NamesOf<capstan::registration::PairFault> {
  using F = capstan::registration::PairFault;
  static constexpr std::array value = {std::pair{F::kTooFewPairs, "fewer than four pairs"},
                                       std::pair{F::kCollinear, "the points lie on one line"},
                                       std::pair{F::kMirrored, "one frame is mirrored"},
                                       std::pair{F::kScale, "lengths in the two frames differ"},
                                       std::pair{F::kNoAgreement, "half of the pairs or fewer agree"},
                                       std::pair{F::kScatter, "the pairs scatter too much"},
                                       std::pair{F::kTooClose, "the points are too close together"}};
};
