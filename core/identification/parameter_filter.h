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

/// Motor samples between two updates of the filter.
struct MotorInterval {
  struct Step {
    tracking::CableArmDrive drive;
    double dt;
  };
  std::vector<Step> steps;
};

/// Parameter filter of the dual UKF, UKF paper (11)–(12): w_{k+1} = w_k + r_k, d_k = G(x_k, w_k) + e_k. G
/// propagates the arm over an interval of motor samples and gives the tip as the camera measures it.
///
/// Each unknown has a prior of variance 1, as in output_error.h: first each logarithm, then each element of
/// CameraPose, divided by its prior sigma. The sigma points are at ±√3 times the columns of S, the
/// central-difference rule (van der Merwe 2004, section 3.4), whose spread does not grow with the number of
/// unknowns. The points advance side by side, one lane per point with its own cable. S is lower triangular
/// with the cable parameters first, so the points of the pose need no propagation.
///
/// Point i starts an interval from x + Φ (ln w_i − ln w); Φ = d x / d ln w is propagated from interval to
/// interval. With creeping friction and soft cables, a link depends on its past for longer than a camera
/// period. Without Φ the filter would underestimate the sensitivity of the output.
class ParameterFilter {
 public:
  static constexpr int kUnknowns = kMostParameters + CameraPose::kSize;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
  using State = tracking::CableArmModel::State;
  using Sensitivity = Eigen::Matrix<double, 6, kMostParameters>;  ///< Φ; columns beyond the set are zero

  /// Innovation of one observation.
  struct Innovation {
    Eigen::Vector3d value;                           ///< observed − predicted tip [m]
    Eigen::Matrix<double, 3, kUnknowns> by_unknown;  ///< d predicted tip / d unknown, from the sigma points
    Eigen::Matrix3d noise_covariance;                ///< of the measurement and of the state [m²]
    Eigen::Matrix3d innovation_covariance;           ///< of `value`: of the noise and of the unknowns [m²]
    double nis = 0.0;     ///< normalized innovation squared: χ² with 3 degrees of freedom
    double weight = 1.0;  ///< Huber's weight; below 1 the observation is down-weighted
  };

  /// `set` and `arm` must outlive the filter; `centre` is that of centreOf().
  ParameterFilter(const ParameterSet& set, const robot::ArmKinematics& arm, const CameraPoseOptions& pose,
                  const Eigen::Vector3d& centre);

  /// Propagates the sigma points over `interval` from state x; then sensitivity() is that at its end.
  void propagate(const State& x, const MotorInterval& interval);
  /// Updates with the observation at the interval's end. `state_noise` is the covariance of the tip from the
  /// state covariance [m²]. An observation beyond `huber` standard deviations has weight huber / its size.
  Innovation update(const CameraObservation& seen, const Eigen::Matrix3d& state_noise, double huber);
  /// Corrects Φ after the state filter took a measurement with gain K: Φ ← (1 − K H) Φ. The corrected part of
  /// the state does not depend on the parameters.
  void correctSensitivity(const Eigen::Matrix<double, 6, 6>& gain_times_h) {
    sensitivity_ -= (gain_times_h * sensitivity_).eval();
  }
  /// Resets Φ to zero, for a restart after a gap.
  void forgetSensitivity() { sensitivity_.setZero(); }
  /// Applies r_k of (11) over `dt` [s]: the variance P of each unknown grows by P (1 − P) dt / memory, never
  /// beyond its prior. So the influence of early observations fades: their sensitivities were those of wrong
  /// parameters.
  void forget(double memory, double dt);

  ParameterSet::Logs logs() const { return scale_.head(n_).cwiseProduct(filter_.mean().head(n_)); }
  CameraPose pose() const { return poseOf(filter_.mean()); }
  const Unknowns& scale() const { return scale_; }
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance() const {
    return filter_.covariance();
  }  ///< covariance of the unknowns
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
  ParameterSet::Logs rate_at_;  ///< logarithms at which rate_ was computed
  double rate_ = 0.0;
};

}  // namespace capstan::identification
