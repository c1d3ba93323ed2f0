#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace capstan::tracking {

/// Distinguishes a marker that jumped from a filter that was wrong.
///
/// A camera observation is accepted when its innovation lies inside the χ² gate. Outside it, the disagreement
/// d = q_cam − q_kin decides: a wrong pulley radius moves d slowly, another object moves it at random. It is
/// then accepted when d agrees with the last accepted d within noise and drift, or as the last of `samples`
/// in a row that agree from one to the next; and only up to `tolerance`, the most that transmission
/// kinematics can be wrong (else a resting object could pass while the robot rests).
class JumpGate {
 public:
  JumpGate(double threshold, int samples, const Eigen::Vector3d& drift, const Eigen::Vector3d& tolerance)
      : threshold_(threshold), samples_(samples), drift_(drift), tolerance_(tolerance) {}

  /// `nis` of the observation (3 degrees of freedom) at time t, its disagreement d and covariance [rad, rad,
  /// m].
  bool accept(double t, double nis, const Eigen::Vector3d& disagreement, const Eigen::Matrix3d& covariance) {
    return accept(t, nis, disagreement, covariance, drift_, tolerance_);
  }
  /// The same with drift and tolerance of its own (a joint whose motor is unknown).
  bool accept(double t, double nis, const Eigen::Vector3d& disagreement, const Eigen::Matrix3d& covariance,
              const Eigen::Vector3d& drift, const Eigen::Vector3d& tolerance) {
    const Seen now{true, t, disagreement, covariance};
    run_ = agree(newest_, now, drift) ? run_ + 1 : 1;
    newest_ = now;
    const bool believable = (disagreement.cwiseAbs().array() <= tolerance.array()).all();
    if (!(nis <= threshold_) && !(believable && (agree(accepted_, now, drift) || run_ >= samples_)))
      return false;
    accepted_ = now;
    return true;
  }
  void reset() { *this = JumpGate(threshold_, samples_, drift_, tolerance_); }

 private:
  struct Seen {
    bool valid = false;
    double t = 0.0;
    Eigen::Vector3d disagreement = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };
  bool agree(const Seen& before, const Seen& now, const Eigen::Vector3d& drift) const {
    if (!before.valid) return false;
    const Eigen::Vector3d change = now.disagreement - before.disagreement;
    Eigen::Matrix3d spread = before.covariance + now.covariance;
    spread.diagonal() += (drift * std::min(now.t - before.t, kLongestDrift)).cwiseAbs2();
    return change.dot(spread.llt().solve(change)) <= threshold_;
  }
  static constexpr double kLongestDrift = 1.0;  ///< [s]; an older agreement says no more than this

  double threshold_;
  int samples_;
  Eigen::Vector3d drift_, tolerance_;
  int run_ = 0;
  Seen newest_, accepted_;
};

}  // namespace capstan::tracking
