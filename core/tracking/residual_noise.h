#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {

/// Covariance of the white part of a residual, from its second differences: for white noise cov(r_k − 2
/// r_{k−1} + r_{k−2}) = 6 R, and a linear drift of the residual adds nothing (von Neumann, Annals of
/// Mathematical Statistics 12, 1941). It is a running mean over about `memory` differences; each is limited
/// to kOutlier times its expected value. With `memory` 0 the stated covariance is used.
class WhiteNoise {
 public:
  /// `gap` is the longest time between neighbours [s].
  WhiteNoise(int memory, double gap);

  void reset() { *this = WhiteNoise(memory_, gap_); }
  /// The covariance in use: `stated` until there are kEnough differences, then the measured one.
  Eigen::Matrix3d value(const Eigen::Matrix3d& stated) const {
    return memory_ == 0 || differences_ < kEnough ? stated : measured_;
  }
  /// Adds the residual at time t [s], with its stated covariance.
  void add(double t, const Eigen::Vector3d& residual, const Eigen::Matrix3d& stated);

  static constexpr int kEnough = 8;
  static constexpr double kOutlier = 9.0;

 private:
  Eigen::Matrix3d measured_ = Eigen::Matrix3d::Zero();
  int memory_;
  double gap_;
  int differences_ = 0;
  int neighbours_ = 0;  ///< number of preceding residuals without a gap
  double newest_ = 0.0;
  Eigen::Vector3d before_[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// Factor in (0, 1] on a stated covariance, adapted to the innovations. It decreases while NIS over its
/// degrees of freedom is below one and increases while it is above one, so that a covariance that was stated
/// too large is reduced to the observed residual (adaptive fading of process noise; Mehra, IEEE TAC 17,
/// 1972). It never exceeds 1: a NIS that stays above one is a fault of the filter.
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
  static constexpr double kGain = 0.02;   ///< gain of the logarithm per innovation
  static constexpr double kLeast = -7.0;  ///< lower bound of the logarithm
  static constexpr double kOutlier = 9.0;
  double log_share_ = 0.0;
};

}  // namespace capstan::tracking
