#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/estimation/square_root_ukf.h"
#include "core/identification/camera_pose.h"
#include "core/identification/identification_data.h"
#include "core/identification/parameters.h"
#include "core/robot/arm_kinematics.h"
#include "core/tracking/cable_arm_model.h"

namespace capstan::identification {

/// One stretch of motor samples between two camera instants.
struct MotorInterval {
  struct Step {
    tracking::CableArmDrive drive;
    double dt;
  };
  std::vector<Step> steps;
};

/// The parameter half of a dual filter, UKF paper (11)–(12): w_{k+1} = w_k + r_k, d_k = G(x_k, w_k) + e_k,
/// where G carries the arm over an interval of motor samples and projects its tip into the camera.
///
/// Unknowns as in output_error.h: logarithms by their prior sigma, then CameraPose by its own, unit prior
/// each. Sigma points stand at ±√3 S columns, the central-difference rule (van der Merwe 2004, section 3.4),
/// which does not spread with the number of unknowns; they advance side by side, each lane with its own
/// cable. S is lower triangular with the cable parameters first, so the points of the pose need no
/// propagation.
///
/// A point starts an interval from x + Φ (ln w_i − ln w), with Φ = d x / d ln w carried from interval to
/// interval: creeping friction and soft cables make a link remember for longer than a camera period, and a
/// filter without that derivative would take the memory for an insensitive output.
class ParameterFilter {
 public:
  static constexpr int kUnknowns = kMostParameters + CameraPose::kSize;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  using State = tracking::CableArmModel::State;
  using Sensitivity = Eigen::Matrix<double, 6, kMostParameters>;  ///< columns behind the set's size are zero

  /// What one observation said.
  struct Innovation {
    Eigen::Vector3d value;                           ///< seen − predicted tip [m]
    Eigen::Matrix<double, 3, kUnknowns> by_unknown;  ///< d predicted tip / d unknown, over the sigma points
    Eigen::Matrix3d covariance;                      ///< of the noise, as used [m²]
    double nis = 0.0;                                ///< chi-square with 3 degrees of freedom
    double weight = 1.0;                             ///< Huber's; below 1 the observation is held back
  };

  /// `set` and `arm` must outlive it; `centre` as centreOf().
  ParameterFilter(const ParameterSet& set, const robot::ArmKinematics& arm, const CameraPoseOptions& pose,
                  const Eigen::Vector3d& centre);

  /// Carries the sigma points over `interval` from state x; sensitivity() is that of its end.
  void propagate(const State& x, const MotorInterval& interval);
  /// Takes the tip seen at the interval's end; `state_noise` is the tip's covariance by the state's own.
  /// Observations beyond `huber` standard deviations count as if they were there.
  Innovation update(const CameraObservation& seen, const Eigen::Matrix3d& state_noise, double huber);
  /// The states took a measurement with gain K: Φ ← (1 − K H) Φ. What the measurement moved no longer depends
  /// on the parameters.
  void correctSensitivity(const Eigen::Matrix<double, 6, 6>& gain_times_h) {
    sensitivity_ -= (gain_times_h * sensitivity_).eval();
  }
  /// Resets Φ: the arm was lost.
  void forgetSensitivity() { sensitivity_.setZero(); }
  /// r_k of (11) over dt: each unknown's variance P grows by P (1 − P) dt / memory, never beyond its prior.
  /// What was learnt while the parameters were far off was learnt with the wrong sensitivities, and fades.
  void forget(double memory, double dt);

  ParameterSet::Logs logs() const { return scale_.head(n_).cwiseProduct(filter_.mean().head(n_)); }
  CameraPose pose() const { return poseOf(filter_.mean()); }
  const Unknowns& scale() const { return scale_; }
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance() const {
    return filter_.covariance();
  }  ///< of unknowns
  const Sensitivity& sensitivity() const { return sensitivity_; }
  std::uint64_t rescues() const { return filter_.rescues(); }

 private:
  static constexpr int kMostPoints = 1 + 2 * kMostParameters;
  static constexpr int kBatches = (kMostPoints + tracking::kCableArmLanes - 1) / tracking::kCableArmLanes;
  using Lanes = Eigen::Matrix<double, 6, tracking::kCableArmLanes, Eigen::RowMajor>;

  CameraPose poseOf(const Unknowns& x) const;
  int points() const { return 1 + 2 * n_; }
  Unknowns point(int index) const;
  void draw(const State& x);
  double fastestRate();
  Eigen::Vector3d observe(int propagated, const CameraPose& pose) const;

  const ParameterSet& set_;
  const robot::ArmKinematics& arm_;
  const tracking::CableArmKernel* kernel_;
  tracking::CableArmConstants constants_;
  Eigen::Vector3d centre_;
  int n_;
  Unknowns scale_ = Unknowns::Zero();
  estimation::SquareRootUkf<kUnknowns> filter_;
  Sensitivity sensitivity_ = Sensitivity::Zero();
  std::array<tracking::CableArmVariation, kBatches> cables_;
  alignas(64) std::array<Lanes, kBatches> states_;
  ParameterSet::Logs rate_at_;  ///< logarithms that rate_ was computed for
  double rate_ = 0.0;
};

}  // namespace capstan::identification
