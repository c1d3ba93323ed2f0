#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {

/// Covariance of the white part of a residual, from its second differences: for white noise
/// cov(r_k − 2 r_{k−1} + r_{k−2}) = 6 R, and a residual that drifts evenly adds nothing (von Neumann, Annals
/// of Mathematical Statistics 12, 1941). A running mean over about `memory` differences; one beyond kOutlier
/// times what is expected counts as that. With no memory, what is stated.
class WhiteNoise {
 public:
  /// `gap` is the longest time between neighbours [s].
  WhiteNoise(int memory, double gap);

  void reset() { *this = WhiteNoise(memory_, gap_); }
  /// The covariance in use: `stated` until kEnough differences were seen, then the measured one.
  Eigen::Matrix3d value(const Eigen::Matrix3d& stated) const {
    return memory_ == 0 || differences_ < kEnough ? stated : measured_;
  }
  /// A residual of time t [s].
  void add(double t, const Eigen::Vector3d& residual, const Eigen::Matrix3d& stated);

  static constexpr int kEnough = 8;
  static constexpr double kOutlier = 9.0;

 private:
  Eigen::Matrix3d measured_ = Eigen::Matrix3d::Zero();
  int memory_;
  double gap_;
  int differences_ = 0;
  int neighbours_ = 0;  ///< of the newest residual, without a gap
  double newest_ = 0.0;
  Eigen::Vector3d before_[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// The share in (0, 1] of a stated covariance that innovations bear out: it falls while their NIS over its
/// degrees of freedom is below one, and rises while it is above, so that a covariance stated too large is
/// lowered to the observed residual (adaptive fading of process noise; Mehra, IEEE TAC 17, 1972). Never above
/// what is stated: a NIS that stays above one is the filter's failure.
class StatedShare {
 public:
  double value() const { return std::exp(log_share_); }
  void add(double nis_by_freedom) {
    if (!std::isfinite(nis_by_freedom)) return;
    const double excess = std::min(nis_by_freedom, kOutlier) - 1.0;
    log_share_ = std::clamp(log_share_ + kGain * excess, kLeast, 0.0);
  }
  void reset() { log_share_ = 0.0; }

 private:
  static constexpr double kGain = 0.02;   ///< of the logarithm, per innovation
  static constexpr double kLeast = -7.0;  ///< of the logarithm
  static constexpr double kOutlier = 9.0;
  double log_share_ = 0.0;
};

}  // namespace capstan::tracking
