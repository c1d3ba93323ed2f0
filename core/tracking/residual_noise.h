#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {

/// Covariance of the white part of a residual: R + s² u uᵀ, where R belongs to the measurement, s is the
/// standard deviation of its time stamps and u the speed at which the residual changes with an error of the
/// stamp. Images without a stamp have the time of their arrival, which a network makes irregular.
///
/// Both are estimated from second differences: for white noise cov(r_k − 2 r_{k−1} + r_{k−2}) = 6 R + s² (u_k
/// u_kᵀ + 4 u_{k−1} u_{k−1}ᵀ + u_{k−2} u_{k−2}ᵀ), and a linear drift of the residual adds nothing (von
/// Neumann, Annals of Mathematical Statistics 12, 1941). R follows by expectation-maximisation, as a running
/// mean over about `memory` differences, and log s² by Fisher scoring (variance components; Harville, Journal
/// of the American Statistical Association 72, 1977). Each difference is limited to kOutlier times its
/// expected value. With `memory` 0 both stay as stated; a
/// stated s of 0 stays 0.
class WhiteNoise {
 public:
  /// `gap` is the longest time between neighbours [s]; `clock_sigma` the stated s [s].
  WhiteNoise(int memory, double gap, double clock_sigma);

  void reset() { *this = WhiteNoise(memory_, gap_, stated_clock_sigma_); }
  /// The covariance at this speed u; its R is `stated` until there are kEnough differences, then the measured
  /// one.
  Eigen::Matrix3d value(const Eigen::Matrix3d& stated, const Eigen::Vector3d& speed) const {
    return ofMeasurement(stated) + std::exp(log_clock_) * speed * speed.transpose();
  }
  /// Standard deviation s of the time stamps [s].
  double clockSigma() const { return std::exp(0.5 * log_clock_); }
  /// Adds the residual at time t [s], with its speed u and the stated R.
  void add(double t, const Eigen::Vector3d& residual, const Eigen::Vector3d& speed,
           const Eigen::Matrix3d& stated);

  static constexpr int kEnough = 8;
  static constexpr double kOutlier = 9.0;

 private:
  struct Residual {
    Eigen::Vector3d value = Eigen::Vector3d::Zero(), speed = Eigen::Vector3d::Zero();
  };
  const Eigen::Matrix3d& ofMeasurement(const Eigen::Matrix3d& stated) const {
    return memory_ == 0 || differences_ < kEnough ? stated : measured_;
  }
  void addDifference(const Residual& now, const Eigen::Matrix3d& stated);

  Eigen::Matrix3d measured_ = Eigen::Matrix3d::Zero();
  int memory_;
  double gap_, stated_clock_sigma_;
  double log_clock_;          ///< log s²
  double information_ = 1.0;  ///< about it
  int differences_ = 0;
  int neighbours_ = 0;  ///< number of preceding residuals without a gap
  double newest_ = 0.0;
  Residual before_[2];
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
