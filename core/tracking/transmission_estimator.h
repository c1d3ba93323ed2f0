#pragma once

#include <Eigen/Core>

#include "core/estimation/change_test.h"
#include "core/estimation/sparse_regression.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/tracking/motor_correction.h"
#include "core/tracking/options.h"
#include "core/tracking/residual_noise.h"
#include "core/tracking/transmission_estimate.h"

namespace capstan::tracking {

/// The slow half of the augmented filter: per joint a scale of cable travel (a pulley's radius), an offset of
/// the cable's zero and a factor of its compliance, estimated from the camera beside the six-state filter of
/// the joints.
///
/// Separate-bias estimation (Friedland, IEEE TAC 14, 1969): cables settle within b_e / k_e, some
/// milliseconds, so the joints follow the corrected motors and the two halves exchange a mean and a
/// sensitivity. With the six-state estimate q at the exposure, its cable stretch delta and the tip position p
/// seen by the camera,
///
///     p − tip(q) = J A⁻¹ (1 / r_l) ∘ (s_m ∘ (e − e') + (o − o') + kappa ∘ delta) + c_t + c_r × (p − p_hs) +
///     c_s (p − p_hs) − J dq tau + v,
///
/// e', o' the correction in use, kappa = 1 − k_e / k_e,true of the robot file's stiffness. c_r, c_t are the
/// registration's error, c_s that of the cameras' scale (focal length, base line) and tau that of the stamps:
/// a camera that is turned and a pulley that is wrong look alike until the arm has moved. Each has a prior,
/// and a much wider one if cameras were moved (TrackingOptions). v is white noise, measured (WhiteNoise),
/// plus J cable_error, which keeps its sign for cable_error_time: as noise that is new in each frame it
/// counts 2 cable_error_time / camera_period times. Where innovations are larger than all this lets expect,
/// observations count for less by the same factor.
///
/// Scale, offset and compliance are zero unless the camera's evidence says otherwise (SparseRegression).
/// Observations of about a second are weighed together, and first against a change: a camera that was
/// knocked, an encoder that slipped (ChangeTest). An estimate that is no laboratory's (scale or offset beyond
/// kMostSigmas of the prior, a compliance of cables kHardest stiffer or any softer than none) is absent.
/// No allocation.
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
    double nis;             ///< by its predicted covariance: chi-square, 3 degrees of freedom
  };
  static constexpr double kMostSigmas = 6.0;
  static constexpr double kHardest = 5.0;

  /// Throws base::InputError for a robot that is no three-joint remote-centre arm.
  TransmissionEstimator(const robot::Description& robot, const TrackingOptions& options);

  void reset();
  /// The clock restarts; what was learned stays.
  void restartClock();
  /// The cameras were registered again: nothing is known of their error.
  void forgetCameras();
  Innovation innovation(const Observation& seen) const;
  /// Takes an accepted observation. The correction changes when it closes a segment.
  void add(const Observation& seen);
  /// No camera until t: what was learned is discounted.
  void age(double t);

  /// How much later than exposures stamps are, beyond camera_delay, as far as it is known [s].
  double delay() const { return delay_; }
  /// What the motors' positions are corrected by.
  const MotorCorrection& correction() const { return correction_; }
  const TransmissionEstimate& estimate() const { return estimate_; }
  /// Joints [rad, rad, m] of transmission kinematics, corrected by what is in use.
  Eigen::Vector3d corrected(const Eigen::Vector3d& q_kin) const;
  /// How far a change of correction moves the joints at q_kin [rad, rad, m].
  Eigen::Vector3d shift(const Eigen::Vector3d& q_kin, const MotorCorrection& from,
                        const MotorCorrection& to) const;
  /// What a stiffness that is wrong takes from the estimate q at q_kin [rad, rad, m]: to be added.
  Eigen::Vector3d stretchError(const Eigen::Vector3d& q_kin, const Eigen::Vector3d& q) const;
  /// What the correction's uncertainty adds to the covariance of the joints at q_kin [rad², rad², m²].
  Eigen::Matrix3d jointCovariance(const Eigen::Vector3d& q_kin) const;
  /// How far q_cam differs from q beyond what the correction in use is for: by the estimated errors of
  /// registration, stamps and stiffness [rad, rad, m].
  Eigen::Vector3d residual(const Observation& seen) const;

 private:
  static constexpr int kStates = 17, kOptional = 9, kCamera = kStates - kOptional;
  static constexpr int kMotor = 6, kDelay = kStates - 1;  // scale and offset come first
  using Regression = estimation::SparseRegression<kStates, kOptional>;
  using Information = estimation::Information<kStates>;
  using Sensitivity = Eigen::Matrix<double, 3, kStates>;
  static constexpr int kSegments = 12, kKinds = 4;

  /// What an observation says of the coefficients: z = h x + v.
  struct Reading {
    Sensitivity h;
    Eigen::Vector3d z;
    Eigen::Matrix3d white;   ///< covariance of v that is new in each frame [m²]
    Eigen::Matrix3d cables;  ///< and of what cables leave unexplained
  };

  Reading reading(const Observation& seen) const;
  Innovation innovation(const Reading& reading) const;
  Eigen::Matrix<double, 3, kMotor> jointSensitivity(const Eigen::Vector3d& travel) const;
  Eigen::Vector3d travelOf(const Eigen::Vector3d& q_kin) const;
  Eigen::Vector3d correctedTravel(const Eigen::Vector3d& travel) const;
  void judgeFit(const Reading& reading);
  void passTime(double t);
  void closeSegment();
  void expectChange(int kind);
  void takeOutDelay();
  void select();
  void publish();

  robot::ArmKinematics arm_;
  robot::Transmission transmission_;
  Eigen::Matrix3d joints_from_travel_;  ///< A⁻¹ diag(1 / r_l)
  Eigen::Vector3d homing_, hard_stop_;
  TrackingOptions options_;
  Regression::Prior prior_;
  Regression regression_;
  estimation::ChangeTest<kStates, kKinds, kSegments> changes_;
  Information segment_;  ///< since the last one closed
  WhiteNoise white_;
  Regression::Matrix covariance_;   ///< of all states, discounted
  Regression::Vector widest_mean_;  ///< with every coefficient present
  Regression::Matrix widest_covariance_;
  double misfit_ = 1.0;  ///< running mean of NIS over its degrees of freedom, every coefficient present
  StatedShare share_;    ///< of the covariance of coefficients and cables
  Regression::Vector used_ = Regression::Vector::Zero();  ///< what the estimate q is corrected for
  MotorCorrection correction_;
  TransmissionEstimate estimate_;
  double delay_ = 0.0;                         ///< taken out of the stamps [s]
  double newest_ = 0.0, segment_start_ = 0.0;  ///< [s]
  double forgotten_ = 1.0;                     ///< factor since the last segment closed
  bool started_ = false;
};

}  // namespace capstan::tracking
