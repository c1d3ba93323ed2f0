#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/estimation/consistency.h"
#include "core/estimation/delayed_filter.h"
#include "core/estimation/occlusion_gate.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/fold_effects.h"
#include "core/stats/chi_square.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/camera_noise.h"
#include "core/tracking/camera_reading.h"
#include "core/tracking/encoder_watch.h"
#include "core/tracking/estimate_view.h"
#include "core/tracking/joint_observation.h"
#include "core/tracking/jump_gate.h"
#include "core/tracking/motor_side.h"
#include "core/tracking/partial_kinematics.h"
#include "core/tracking/pipeline.h"
#include "core/tracking/pipeline_parts.h"
#include "core/tracking/stereo_tip.h"
#include "core/tracking/stray_readings.h"
#include "core/tracking/time_series.h"
#include "core/tracking/transmission_estimator.h"

namespace capstan::tracking {

/// Implementation of the pipeline: motor samples here, camera samples in pipeline_camera.cpp.
class TrackingPipeline::Impl {
 public:
  Impl(const robot::Description& robot, std::optional<vision::StereoRig> rig,
       const vision::MarkerOptions& marker, const TrackingOptions& options)
      : robot_(robot),
        rig_(std::move(rig)),
        options_(options),
        numbers_(robot::foldEffects(robot)),
        cameras_(robot),
        arm_(numbers_),
        stray_(numbers_),
        watch_(numbers_, options),
        motors_(robot, options.differentiation_time, memorySize(options)),
        cables_(motors_.transmission()),
        filter_(modelOf(robot, options), diagonalOf(options.position_noise, options.velocity_noise),
                static_cast<int>(memorySize(options))),
        view_(numbers_, filter_.model().extended()),
        noise_(numbers_, options),
        jump_(stats::chiSquareQuantile(3, options.gate_probability), options.jump_samples, options.jump_drift,
              options.jump_tolerance),
        ray_jump_(stats::chiSquareQuantile(2, options.gate_probability), options.jump_samples,
                  options.jump_drift, options.jump_tolerance),
        nis_(3, options.nis_window),
        reference_(memorySize(options)),
        snapshot_(emptySnapshot()) {
    if (rig_) stereo_.emplace(*rig_, marker, options.full_frame_search);
    if (options.filter == FilterKind::kAugmented) slow_.emplace(numbers_, options);
  }

  /// Sets the registration and forgets the estimated camera error, which belongs to the old one.
  void setRegistration(const Eigen::Isometry3d& base_from_camera) {
    const bool moved = base_from_camera_ && !base_from_camera_->isApprox(base_from_camera);
    base_from_camera_ = base_from_camera;
    if (!slow_ || !moved) return;
    const MotorCorrection before = slow_->correction();
    slow_->forgetCameras();
    if (started_) correctSince(snapshot_.t, before);
    nis_.reset();
  }

  void setOwnKinematics(bool own) { snapshot_.own_kinematics = own; }

  /// Pixel noise and NIS are those of the marker.
  void setMarker(const vision::MarkerOptions& marker) {
    if (!rig_) return;
    stereo_.emplace(*rig_, marker, options_.full_frame_search);
    noise_.reset();
    nis_.reset();
  }

  void reset() {
    if (slow_) slow_->reset();
    stray_.clear();
    watch_.clear();
    motors_.clear();
    reference_.clear();
    jump_.reset();
    ray_jump_.reset();
    noise_.reset();
    nis_.reset();
    corrected_since_ = -std::numeric_limits<double>::infinity();
    started_ = reference_pending_ = false;
    const bool own_kinematics = snapshot_.own_kinematics;
    snapshot_ = emptySnapshot();
    snapshot_.own_kinematics = own_kinematics;
    snapshot_.motor_failed = watch_.faults();
  }

  void declare(int motor, bool failed) {
    watch_.declare(motor, failed);
    snapshot_.motor_failed = watch_.faults();
    if (failed && started_) forget(1U << motor, snapshot_.t);
    jump_.reset();
    ray_jump_.reset();
  }

  const Snapshot& step(const Sample& sample) {
    snapshot_.motor_updated = false;
    snapshot_.camera_updated = false;
    snapshot_.reference_paired = false;
    std::visit([this](const auto& one) { take(one); }, sample);
    return snapshot_;
  }

  robot::Description robot_;
  std::optional<vision::StereoRig> rig_;
  TrackingOptions options_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  Snapshot& snapshot() { return snapshot_; }

  using Matrix3d = Eigen::Matrix3d;
  using Vector3d = Eigen::Vector3d;
  using Filter = estimation::DelayedFilter<CableArmModel, JointMeasurement>;

 private:
  // The camera's side: pipeline_camera.cpp.
  void take(const StereoFrame& frame);
  void take(const TipSample& sample);
  double exposureOf(double stamp) const;
  double clockSigma() const;
  void beginCamera(double t, double t_arrival, bool images);
  bool areExchanged(const vision::Triangulation& tip) const;
  void observeImagedTip(const vision::Triangulation& found, const Eigen::Isometry3d& base_from_camera);
  /// Observes the ray of one camera while the other does not see the marker. Nothing without all motors.
  void observeRay(const vision::CameraRay& ray, const Eigen::Isometry3d& base_from_camera);
  /// Converts a tip in frame 0 to q_cam, applies the gate and updates the filter. `covariance` is that of the
  /// tip's error, `white` that of the part that is independent in each frame [m²].
  void observeTip(const Vector3d& tip, const Matrix3d& covariance, const Matrix3d& white);
  /// Publishes the innovation of the joints; of the augmented filter, from that of the tip.
  void showInnovation(const Vector3d& innovation, const Matrix3d& covariance);
  void showInnovation(const TransmissionEstimator::Innovation& tip, const Filter::State& mean);
  TransmissionEstimator::Observation slowObservation(double t, const Vector3d& tip, const Matrix3d& white,
                                                     const Filter::State& mean,
                                                     const Vector3d& kinematic) const;
  /// Takes an observation of the slow errors. If it changes the correction, moves the joint estimates from
  /// the exposure on accordingly.
  void learnTransmission(const TransmissionEstimator::Observation& seen);
  /// Revises the estimates since t [s] for a motor correction that changed from `before`.
  void correctSince(double t, const MotorCorrection& before);
  void forgetFrozen(JointSet frozen);
  /// True if the jump gate accepts the observation. If motor j is unknown, only the camera measures q_j, so
  /// the gate tests the path of q_j itself.
  bool accept(double t, double nis, const JointObservation& seen, const Vector3d& kinematic);
  /// Ends a camera sample. If neither it nor q_kin at its time could be observed, watchSilence() still counts
  /// the camera as silent.
  void endCamera();

  void take(MotorSample sample) {
    const double before = snapshot_.t;
    if (stray_.takeOut(sample)) ++snapshot_.motor_stray;
    const std::optional<MotorSample> known = watch_.take(sample);
    const MotorSide::Taken taken = known ? motors_.take(*known) : MotorSide::Taken::kRefused;
    if (taken == MotorSide::Taken::kRefused) {
      ++snapshot_.motor_refused;
      return;
    }
    if (taken == MotorSide::Taken::kRestart) {
      watch_.restart();
      reference_.clear();
      if (slow_) slow_->restartClock();
      corrected_since_ = -std::numeric_limits<double>::infinity();
      noise_.reset();
      nis_.reset();
      started_ = reference_pending_ = false;
    }
    snapshot_.motor_failed = watch_.faults();
    snapshot_.t = sample.t;
    snapshot_.motor_updated = true;
    ++snapshot_.motor_samples;
    if (!started_ || sample.t - before > options_.restart_gap)
      start(sample.t);
    else
      advance(sample.t, sample.t - before);
    if (sample.t - last_camera_ >= options_.missing_after * options_.camera_period) watchSilence(sample.t);
    showEstimate();
    pairReference();
  }

  void advance(double t, double dt) {
    CableArmModel::Control now = control();
    now.memory = cables_before_.advance(filter_.model(), filter_.mean(), now, dt);
    view_.setMemory(now.memory);
    filter_.advance(t, now);
  }

  void take(const JointSample& sample) {
    if (!sample.position.allFinite()) return;
    reference_.push(sample.t, sample.position);
    snapshot_.q_link_true = sample.position;
    reference_time_ = sample.t;
    reference_pending_ = true;
    pairReference();
  }

  /// Starts the filter at t [s]. The joint of an unknown motor gets the standard deviation of a uniform
  /// distribution over its range.
  void start(double t) {
    Filter::State mean = Filter::State::Zero();
    const JointSet unknown = watch_.unknown();
    const Vector3d q = kinematicGiven(corrected(motors_.kinematic()), snapshot_.q_link_ukf);
    const Vector3d speed = motors_.transmission().jointVelocityFromMotor(motors_.velocity());
    Vector3d position_sigma = options_.initial_position_sigma,
             velocity_sigma = options_.initial_velocity_sigma;
    for (int joint = 0; joint < 3; ++joint) {
      mean(2 * joint) = q(joint);
      mean(2 * joint + 1) = contains(unknown, joint) ? 0.0 : speed(joint);
      if (!contains(unknown, joint)) continue;
      const robot::Joint& range = robot_.joints[static_cast<std::size_t>(joint)];
      position_sigma(joint) = (range.limit_high - range.limit_low) / std::sqrt(12.0);
      velocity_sigma(joint) = options_.unknown_speed(joint);
    }
    cables_before_ = RememberedCables(control());
    filter_.reset(t, mean, diagonalOf(position_sigma, velocity_sigma), control());
    jump_.reset();
    ray_jump_.reset();
    last_camera_ = last_kinematic_ = last_seen_ = t;
    last_late_ = kNever;
    started_ = true;
  }

  /// Discards the readings of the motors in `set` from the time `since` on. The estimates of their joints
  /// restart there with the mean that they had.
  void forget(JointSet set, double since) {
    filter_.revise(
        since, [set](CableArmModel::Control& control) { control.unknown |= set; },
        [&](Filter::State& mean, estimation::Lower<6>& root) {
          forgetJoints(set, options_.jump_tolerance, options_.unknown_speed, mean, root);
        });
    jump_.reset();
    ray_jump_.reset();
  }

  /// q_kin of the known motors, with `reference` in place of the unknown ones.
  Vector3d kinematicGiven(const Vector3d& kinematic, const Vector3d& reference) const {
    const JointSet unknown = watch_.unknown();
    if (unknown == 0 || !reference.allFinite()) return kinematic;
    return cables_.given(kinematic, unknown, reference);
  }

  /// q_kin at an earlier time t [s], with the estimate of that time for unknown motors; nothing outside the
  /// memory.
  std::optional<Vector3d> kinematicAt(double t) {
    const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
    if (!kinematic || watch_.unknown() == 0) return kinematic;
    const auto state = filter_.at(t);
    if (!state) return std::nullopt;
    const auto& mean = (*state)->mean();
    return kinematicGiven(*kinematic, Vector3d(mean(0), mean(2), mean(4)));
  }

  CableArmModel::Control control() const {
    return {motors_.position(),
            motors_.velocity(),
            watch_.unknown(),
            std::max(snapshot_.t - last_seen_, 0.0),
            {},
            slow_ ? slow_->correction() : MotorCorrection{}};
  }

  /// q_kin, corrected for the slow errors of the transmission that the filter includes.
  Vector3d corrected(const Vector3d& kinematic) const {
    return slow_ ? slow_->corrected(kinematic) : kinematic;
  }

  /// Handles a camera without samples, or with such that are too late: observes q_kin at the camera's rate.
  void watchSilence(double t) {
    constexpr double kLateAgo = 1.0;  // [s]
    snapshot_.gate = t - last_late_ < kLateAgo ? Gate::kLate : Gate::kNoCamera;
    if (t - last_kinematic_ >= options_.camera_period) (void)observeKinematics(t);
  }

  /// Observes q_kin of the known motors (UKF paper, section V-D: hard switch). False for a time outside the
  /// memory.
  bool observeKinematics(double t) {
    const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
    if (!started_ || !kinematic) return false;
    if (slow_) slow_->age(t);
    const KinematicObservation seen =
        cables_.observe(corrected(*kinematic), watch_.unknown(), options_.kinematic_sigma);
    const auto report = filter_.update(t, seen.measurement, seen.y, seen.root);
    if (!report) return false;
    snapshot_.nis = report->nis;
    last_kinematic_ = snapshot_.t;
    return true;
  }

  void showEstimate() {
    snapshot_.rescues = filter_.rescues();
    Eigen::Matrix<double, 6, 6> covariance = filter_.covariance();
    if (slow_) {
      const Matrix3d of_joints = slow_->jointCovariance(motors_.kinematic());
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) covariance(2 * i, 2 * j) += of_joints(i, j);
      snapshot_.transmission = slow_->estimate();
      view_.setCorrection(slow_->correction());
    }
    CableArmModel::State mean = filter_.mean();
    if (slow_ && watch_.unknown() == 0) {
      const Vector3d error = slow_->stretchError(motors_.kinematic(), Vector3d(mean(0), mean(2), mean(4)));
      for (int joint = 0; joint < 3; ++joint) mean(2 * joint) += error(joint);
    }
    view_.show(mean, covariance, motors_, watch_, snapshot_);
  }

  void pairReference() {
    if (!reference_pending_ || !started_ || std::abs(reference_time_ - snapshot_.t) > kSameTime) return;
    reference_pending_ = false;
    snapshot_.reference_paired = true;
    if (snapshot_.own_kinematics) return;
    const Vector3d error = snapshot_.q_link_ukf - snapshot_.q_link_true;
    snapshot_.nees = error.dot(view_.positionCovariance().llt().solve(error));
  }

  /// Largest time difference of a reference and a motor sample that are compared [s].
  static constexpr double kSameTime = 0.5e-3;

  robot::Description numbers_;  ///< robot_ after robot::foldEffects()
  CameraReading cameras_;
  robot::ArmKinematics arm_;
  StrayReadings stray_;
  EncoderWatch watch_;
  MotorSide motors_;
  PartialKinematics cables_;
  std::optional<StereoTip> stereo_;
  Filter filter_;
  std::optional<TransmissionEstimator> slow_;  ///< present in the augmented filter only
  EstimateView view_;
  const JointMeasurement positions_ = positionsOnly();
  CameraNoise noise_;
  JumpGate jump_;
  JumpGate ray_jump_;  ///< the same for the ray of one camera, which two numbers measure
  estimation::ConsistencyWindow nis_;
  TimeSeries reference_;
  Snapshot snapshot_;
  RememberedCables cables_before_;
  double last_camera_ = 0.0, last_kinematic_ = 0.0;  ///< arrival of their last update, motors' clock [s]
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  double last_late_ = kNever;  ///< arrival of the last camera sample that was too late [s]
  double last_seen_ = 0.0;     ///< exposure of the newest tip that was accepted [s]
  /// Time from which the correction in use holds [s].
  double corrected_since_ = -std::numeric_limits<double>::infinity();
  double reference_time_ = 0.0;
  bool started_ = false, reference_pending_ = false;
  bool nis_of_transmission_ = false;  ///< nis_ averages the NIS of the slow errors (all motors known)
};

}  // namespace capstan::tracking
