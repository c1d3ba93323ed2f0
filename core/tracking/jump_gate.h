#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace capstan::tracking {

/// Gate that distinguishes a marker that jumped from a filter whose estimate was wrong.
///
/// A camera observation is accepted when its innovation lies inside the χ² gate. Outside the gate, the
/// disagreement d = q_cam − q_kin decides: a wrong pulley radius changes d slowly, another object changes d
/// at random. The observation is then accepted when d agrees with the last accepted d within noise and drift,
/// or when it is the last of `samples` successive observations that each agree with the one before. In this
/// case |d| must also be at most `tolerance`, the largest possible error of transmission kinematics;
/// otherwise an object at rest could pass while the robot rests.
class JumpGate {
 public:
  JumpGate(double threshold, int samples, const Eigen::Vector3d& drift, const Eigen::Vector3d& tolerance)
      : threshold_(threshold), samples_(samples), drift_(drift), tolerance_(tolerance) {}

  /// True if the observation at time t [s] is accepted; `nis` has 3 degrees of freedom, `disagreement` is d,
  /// and `covariance` that of q_cam [rad, rad, m].
  bool accept(double t, double nis, const Eigen::Vector3d& disagreement, const Eigen::Matrix3d& covariance) {
    return accept(t, nis, disagreement, covariance, drift_, tolerance_);
  }
  /// Like accept() above, with other values of drift and tolerance (a joint whose motor is unknown).
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
  static constexpr double kLongestDrift = 1.0;  ///< longest time over which drift is counted [s]

  double threshold_;
  int samples_;
  Eigen::Vector3d drift_, tolerance_;
  int run_ = 0;
  Seen newest_, accepted_;
};

}  // namespace capstan::tracking
