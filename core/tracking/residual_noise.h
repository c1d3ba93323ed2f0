#pragma once

#include <Eigen/Core>

namespace capstan::tracking {

/// Covariance of the white part of a residual, from its second differences: for white noise
/// cov(r_k − 2 r_{k−1} + r_{k−2}) = 6 R, and a residual that drifts evenly adds nothing (von Neumann, Annals
/// of Mathematical Statistics 12, 1941). A running mean over about `memory` differences; one beyond kOutlier
/// times what is expected counts as that.
class WhiteNoise {
 public:
  /// `gap` is the longest time between neighbours [s].
  WhiteNoise(int memory, double gap);

  void reset() { *this = WhiteNoise(memory_, gap_); }
  /// The covariance in use: `stated` until kEnough differences were seen, then the measured one.
  Eigen::Matrix3d value(const Eigen::Matrix3d& stated) const {
    return differences_ < kEnough ? stated : measured_;
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

/// Covariance of innovations, measured from the innovations themselves (innovation-based adaptive
/// estimation; Mehra, IEEE TAC 15, 1970; Mohamed and Schwarz, Journal of Geodesy 73, 1999): a running mean
/// over about `memory` of them. By it the NIS of the next innovation says whether errors are as large as they
/// were of late.
class InnovationCovariance {
 public:
  explicit InnovationCovariance(int memory);

  void reset() { *this = InnovationCovariance(memory_); }
  /// The covariance in use: `predicted` until kEnough innovations were seen, then the measured one.
  Eigen::Matrix3d value(const Eigen::Matrix3d& predicted) const {
    return count_ < kEnough ? predicted : measured_;
  }
  /// `nis` is the innovation's, by value(); beyond kOutlier times what is expected it counts as that.
  void add(const Eigen::Vector3d& innovation, double nis);

  static constexpr int kEnough = 30;
  static constexpr double kOutlier = 9.0;

 private:
  Eigen::Matrix3d measured_ = Eigen::Matrix3d::Zero();
  int memory_;
  int count_ = 0;
};

}  // namespace capstan::tracking
