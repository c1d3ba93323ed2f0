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

/// Slow part of the augmented filter. It estimates, per joint, the scale of cable travel (pulley radius), the
/// offset of the cable's zero and a factor of the cable's compliance from camera observations. It runs in
/// parallel with the six-state filter of the joints.
///
/// Separate-bias estimation (Friedland, IEEE TAC 14, 1969): cables settle within b_e / k_e, a few
/// milliseconds, so the joints follow the corrected motors, and the two filters exchange a mean and a
/// sensitivity. With the six-state estimate q at the exposure, its cable stretch delta and the tip position p
/// observed by the camera,
///
///     p − tip(q) = J A⁻¹ (1 / r_l) ∘ (s_m ∘ (e − e') + (o − o') + kappa ∘ delta) + c_t + c_r × (p − p_hs) +
///     c_s (p − p_hs) − J dq tau + v,
///
/// e', o' are the correction in use, and kappa = 1 − k_e / k_e,true with k_e of the robot file. c_r and c_t
/// are the registration error, c_s the error of the cameras' scale (focal length, base line), and tau the
/// error of the stamps. The camera errors are estimated too, because a rotated camera and a wrong pulley have
/// the same effect until the arm has moved. Each has a prior, and a much wider one if cameras were moved
/// (TrackingOptions). v is white noise, measured by WhiteNoise, plus J cable_error. cable_error keeps its
/// sign for cable_error_time, so its covariance is multiplied by 2 cable_error_time / T to count as
/// independent noise per frame, where T is the measured time between observations: the information about a
/// slow error grows with time, not with the number of images. Where innovations are larger than this model
/// predicts, the weight of observations is reduced by the same factor.
///
/// Scale, offset and compliance are zero unless there is evidence for them (SparseRegression). Observations
/// of about one second form a segment. Each segment is first tested for a change: a camera that was moved, or
/// an encoder that slipped (ChangeTest). Implausible estimates are excluded: scale or offset beyond
/// kMostSigmas of the prior, a true stiffness below 1 / kHardest of the robot file's, or a negative one. No
/// allocation.
class TransmissionEstimator {
 public:
  /// One tip observed by the camera at its exposure t [s].
  struct Observation {
    double t = 0.0;
    Eigen::Vector3d tip;     ///< observed tip in frame 0 [m]
    Eigen::Matrix3d noise;   ///< stated covariance of the tip's white noise [m²]
    Eigen::Vector3d q, dq;   ///< estimate at t with the correction in use [rad, rad, m], [rad/s, rad/s, m/s]
    Eigen::Vector3d travel;  ///< cable travel s_m of the motors at t, without correction [m]
    /// Covariance of a coordinate that was not measured, as along the ray of one camera [m²].
    Eigen::Matrix3d open = Eigen::Matrix3d::Zero();
  };
  struct Innovation {
    Eigen::Vector3d value;       ///< innovation of the tip [m]
    Eigen::Matrix3d covariance;  ///< predicted covariance of value [m²]
    double nis;                  ///< NIS under the predicted covariance: chi-square, 3 degrees of freedom
  };
  static constexpr double kMostSigmas = 6.0;
  static constexpr double kHardest = 5.0;

  /// Throws base::InputError for a robot that is not a three-joint remote-centre arm.
  TransmissionEstimator(const robot::Description& robot, const TrackingOptions& options);

  void reset();
  /// Restarts the clock; estimates stay.
  void restartClock();
  /// Forgets the camera errors after a new registration.
  void forgetCameras();
  Innovation innovation(const Observation& seen) const;
  /// Adds an accepted observation. The correction changes when the observation closes a segment.
  void add(const Observation& seen);
  /// Adds a point on the ray of one camera. Such points do not judge the noise or the fit, because they
  /// measure two numbers.
  void addRay(const Observation& seen);
  /// Discounts the estimates for the time until t [s] without camera observations.
  void age(double t);

  /// Known part of the time stamps' delay after exposure, beyond camera_delay [s].
  double delay() const { return delay_; }
  /// Measured standard deviation of the time stamps of camera samples [s].
  double clockSigma() const { return white_.clockSigma(); }
  /// Correction of the motor positions.
  const MotorCorrection& correction() const { return correction_; }
  const TransmissionEstimate& estimate() const { return estimate_; }
  /// Joints [rad, rad, m] of transmission kinematics with the correction in use.
  Eigen::Vector3d corrected(const Eigen::Vector3d& q_kin) const;
  /// Movement of the joints at q_kin that a change of correction causes [rad, rad, m].
  Eigen::Vector3d shift(const Eigen::Vector3d& q_kin, const MotorCorrection& from,
                        const MotorCorrection& to) const;
  /// Error of the estimate q at q_kin from a wrong stiffness [rad, rad, m]; it must be added to q.
  Eigen::Vector3d stretchError(const Eigen::Vector3d& q_kin, const Eigen::Vector3d& q) const;
  /// Covariance of the joints at q_kin that comes from the correction's uncertainty [rad², rad², m²]. An
  /// error that is not estimated counts with its probability p: p E[x²] of the model with every coefficient
  /// (Bayesian model averaging, Hoeting et al., Statistical Science 14, 1999, without the correlations).
  /// Before the first camera observation this is its prior.
  Eigen::Matrix3d jointCovariance(const Eigen::Vector3d& q_kin) const;
  /// Difference of q_cam and q that the correction in use does not cover: the effect of the estimated errors
  /// of registration, stamps and stiffness [rad, rad, m].
  Eigen::Vector3d residual(const Observation& seen) const;

 private:
  static constexpr int kStates = 17, kOptional = 9, kCamera = kStates - kOptional;
  static constexpr int kMotor = 6, kDelay = kStates - 1;  // scale and offset come first, the delay last
  using Regression = estimation::SparseRegression<kStates, kOptional>;
  using Information = estimation::Information<kStates>;
  using Sensitivity = Eigen::Matrix<double, 3, kStates>;
  static constexpr int kSegments = 12, kKinds = 4;

  /// Linear measurement of the coefficients x by one observation: z = h x + v.
  struct Reading {
    Sensitivity h;
    Eigen::Vector3d z;
    Eigen::Matrix3d white;   ///< covariance of the part of v that is independent in each frame [m²]
    Eigen::Matrix3d cables;  ///< covariance of unexplained cable errors [m²]
  };

  Reading reading(const Observation& seen) const;
  Innovation innovation(const Reading& reading) const;
  Eigen::Matrix<double, 3, kMotor> jointSensitivity(const Eigen::Vector3d& travel) const;
  Eigen::Vector3d travelOf(const Eigen::Vector3d& q_kin) const;
  Eigen::Vector3d correctedTravel(const Eigen::Vector3d& travel) const;
  void judgeFit(const Reading& reading);
  void accumulate(double t, const Reading& reading);
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
  Information segment_;  ///< observations since the last segment closed
  WhiteNoise white_;
  Regression::Matrix covariance_;   ///< covariance of all states, discounted
  Regression::Vector widest_mean_;  ///< mean with every coefficient present
  Regression::Matrix widest_covariance_;
  double misfit_ = 1.0;  ///< running mean of NIS over its degrees of freedom, with every coefficient present
  StatedShare share_;    ///< factor on the covariance of coefficients and cables
  Regression::Vector used_ = Regression::Vector::Zero();  ///< coefficients that the estimate q includes
  MotorCorrection correction_;
  TransmissionEstimate estimate_;
  double delay_ = 0.0;                         ///< delay subtracted from the stamps [s]
  double newest_ = 0.0, segment_start_ = 0.0;  ///< [s]
  double forgotten_ = 1.0;                     ///< forgetting factor since the last segment closed
  double period_;                              ///< running mean of the time between observations [s]
  int intervals_ = 0;                          ///< in that mean
  bool started_ = false;
};

}  // namespace capstan::tracking
