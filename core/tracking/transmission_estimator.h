#pragma once

#include <Eigen/Core>

#include "core/estimation/sparse_regression.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/tracking/motor_correction.h"
#include "core/tracking/options.h"
#include "core/tracking/residual_noise.h"
#include "core/tracking/transmission_estimate.h"

namespace capstan::tracking {

/// The slow half of the augmented filter: per joint a scale of cable travel (a pulley's radius) and an offset
/// of the cable's zero, estimated from the camera beside the six-state filter of the joints.
///
/// Separate-bias estimation (Friedland, IEEE TAC 14, 1969): cables settle within b_e / k_e, some
/// milliseconds, so the joints follow the corrected motors and the two halves exchange a mean and a
/// sensitivity. With the six-state estimate q at the exposure and tip position p seen by the camera,
///
///     p − tip(q) = J A⁻¹ (1 / r_l) ∘ (s_m ∘ (e − e') + (o − o')) + c_t + c_r × (p − p_hs) + c_s (p − p_hs) −
///     J dq tau + v,
///
/// e', o' the correction in use. c_r, c_t are the registration's error (prior: registration_turn_sigma,
/// registration_shift_sigma; or much wider, of cameras that were moved), c_s that of the cameras' scale
/// (focal length, base line) and tau that of the stamps. They are estimated with it, for a camera that is
/// turned and a pulley that is wrong look alike until the arm has moved. v is white noise, measured
/// (WhiteNoise), plus J cable_error, which keeps its sign for cable_error_time: as noise that is new in each
/// frame it counts 2 cable_error_time / camera_period times.
///
/// Scale and offset are zero unless the camera's evidence says otherwise (SparseRegression): with a robot
/// file that is right the filter is the six-state filter. No allocation.
class TransmissionEstimator {
 public:
  /// One tip seen by the camera at its exposure t [s].
  struct Observation {
    double t = 0.0;
    Eigen::Vector3d tip;     ///< seen, in frame 0 [m]
    Eigen::Matrix3d noise;   ///< stated covariance of its white noise [m²]
    Eigen::Vector3d q, dq;   ///< estimate at t, with the correction in use [rad, rad, m], per second
    Eigen::Vector3d travel;  ///< cable travel s_m of the motors at t, not corrected [m]
  };
  struct Innovation {
    Eigen::Vector3d value;  ///< of the tip [m]
    double nis;             ///< by the covariance of earlier innovations: chi-square, 3 degrees of freedom
  };

  /// Throws base::InputError for a robot that is no three-joint remote-centre arm.
  TransmissionEstimator(const robot::Description& robot, const TrackingOptions& options);

  void reset();
  Innovation innovation(const Observation& seen) const;
  /// Takes an accepted observation.
  void add(const Observation& seen);
  /// No camera until t: what was learned ages.
  void age(double t);

  /// What the motors' positions are corrected by.
  const MotorCorrection& correction() const { return correction_; }
  const TransmissionEstimate& estimate() const { return estimate_; }
  /// Joints [rad, rad, m] of transmission kinematics, corrected by what is in use.
  Eigen::Vector3d corrected(const Eigen::Vector3d& q_kin) const;
  /// How far a change of correction moves the joints at q_kin [rad, rad, m].
  Eigen::Vector3d shift(const Eigen::Vector3d& q_kin, const MotorCorrection& from,
                        const MotorCorrection& to) const;
  /// What the correction's uncertainty adds to the covariance of the joints at q_kin [rad², rad², m²].
  Eigen::Matrix3d jointCovariance(const Eigen::Vector3d& q_kin) const;
  /// How far q_cam is off by the estimated error of registration and stamps [rad, rad, m].
  Eigen::Vector3d cameraError(const Observation& seen) const;

 private:
  static constexpr int kStates = 14, kOptional = 6, kCamera = kStates - kOptional;
  using Regression = estimation::SparseRegression<kStates, kOptional>;
  using Sensitivity = Eigen::Matrix<double, 3, kStates>;

  Sensitivity sensitivity(const Observation& seen, const Eigen::Matrix3d& jacobian) const;
  Eigen::Matrix<double, 3, kOptional> jointSensitivity(const Eigen::Vector3d& travel) const;
  Eigen::Vector3d travelOf(const Eigen::Vector3d& q_kin) const;
  Eigen::Matrix3d cableNoise(const Eigen::Matrix3d& jacobian, double times) const;
  unsigned included() const;  ///< the selected submodel, a bit a coefficient
  void publish();

  robot::ArmKinematics arm_;
  robot::Transmission transmission_;
  Eigen::Matrix3d joints_from_travel_;  ///< A⁻¹ diag(1 / r_l)
  Eigen::Vector3d homing_, hard_stop_;
  TrackingOptions options_;
  Regression regression_;
  WhiteNoise white_;
  InnovationCovariance innovations_;
  Regression::Matrix covariance_;  ///< of all states, aged
  MotorCorrection correction_;
  TransmissionEstimate estimate_;
  double newest_ = 0.0;  ///< [s]
  bool started_ = false;
};

}  // namespace capstan::tracking
