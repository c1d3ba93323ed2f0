#include "core/tracking/pipeline.h"

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
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/camera_noise.h"
#include "core/tracking/camera_reading.h"
#include "core/tracking/encoder_watch.h"
#include "core/tracking/estimate_view.h"
#include "core/tracking/joint_observation.h"
#include "core/tracking/jump_gate.h"
#include "core/tracking/motor_side.h"
#include "core/tracking/partial_kinematics.h"
#include "core/tracking/pipeline_parts.h"
#include "core/tracking/stereo_tip.h"
#include "core/tracking/time_series.h"
#include "core/tracking/transmission_estimator.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using estimation::Lower;
using Filter = estimation::DelayedFilter<CableArmModel, JointMeasurement>;

constexpr double kSameTime = 0.5e-3;  // [s], a reference and a motor sample this close speak of one time
constexpr double kReferenceHold =
    2.5e-3;  // [s], how long the newest reference stands for what comes after it
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

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
        watch_(numbers_, options),
        motors_(robot, options.differentiation_time, memorySize(options)),
        cables_(motors_.transmission()),
        filter_(modelOf(robot, options), diagonalOf(options.position_noise, options.velocity_noise),
                static_cast<int>(memorySize(options))),
        view_(numbers_, filter_.model().extended()),
        noise_(numbers_, options),
        jump_(estimation::chiSquareQuantile(3, options.gate_probability), options.jump_samples,
              options.jump_drift, options.jump_tolerance),
        nis_(3, options.nis_window),
        reference_(memorySize(options)),
        snapshot_(emptySnapshot()) {
    if (rig_) stereo_.emplace(*rig_, marker, options.full_frame_search);
    if (options.filter == FilterKind::kAugmented) slow_.emplace(numbers_, options);
  }

  /// What was learned of the transmission rests on the registration.
  void setRegistration(const Eigen::Isometry3d& base_from_camera) {
    if (slow_ && base_from_camera_ && !base_from_camera_->isApprox(base_from_camera)) slow_->reset();
    base_from_camera_ = base_from_camera;
  }

  void reset() {
    if (slow_) slow_->reset();
    watch_.clear();
    motors_.clear();
    reference_.clear();
    jump_.reset();
    noise_.reset();
    nis_.reset();
    started_ = reference_pending_ = false;
    snapshot_ = emptySnapshot();
    snapshot_.motor_failed = watch_.faults();
  }

  void declare(int motor, bool failed) {
    watch_.declare(motor, failed);
    snapshot_.motor_failed = watch_.faults();
    if (failed && started_) forget(1U << motor, snapshot_.t);
    jump_.reset();
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

 private:
  void take(const MotorSample& sample) {
    const double before = snapshot_.t;
    const std::optional<MotorSample> known = watch_.take(sample);
    const MotorSide::Taken taken = known ? motors_.take(*known) : MotorSide::Taken::kRefused;
    if (taken == MotorSide::Taken::kRefused) {
      ++snapshot_.motor_refused;
      return;
    }
    if (taken == MotorSide::Taken::kAnew) {
      watch_.startAnew();
      reference_.clear();
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

  void take(const StereoFrame& frame) {
    if (!stereo_) return;
    beginCamera(cameras_.time(frame.t) - options_.camera_delay, frame.t_arrival, true);
    std::optional<Vector3d> expected;
    if (options_.roi_search && base_from_camera_ && snapshot_.tip_kin_cam.allFinite())
      expected = base_from_camera_->inverse() * cameras_.told(snapshot_.tip_kin_cam);
    stereo_->find(frame, expected);
    snapshot_.marker = stereo_->markers();
    if ((snapshot_.gate = stereo_->gate()) == Gate::kOpen) {
      const vision::Triangulation tip = stereo_->triangulate();
      if (!tip.found() || std::abs(tip.epipolar_residual) > options_.epipolar_limit) {
        snapshot_.gate = Gate::kJump;
      } else {
        snapshot_.tip_in_camera = tip.position;
        snapshot_.tip_in_camera_covariance = tip.covariance;
        if (base_from_camera_)
          observeImagedTip(tip, *base_from_camera_);
        else
          snapshot_.gate = Gate::kUnregistered;
      }
    }
    endCamera();
  }

  void take(const TipSample& sample) {
    beginCamera(cameras_.time(sample.t) - options_.camera_delay, sample.t_arrival, false);
    snapshot_.gate = Gate::kBothLost;
    if (sample.position.allFinite()) {
      const Vector3d tip = cameras_.point(sample.position);
      observeTip(tip, noise_.ofTip(tip), options_.tip_sigma.cwiseAbs2().asDiagonal());
    }
    endCamera();
  }

  /// The joints of unknown motors are anywhere in their range, as far as the motors tell.
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
    last_camera_ = last_kinematic_ = last_seen_ = t;
    started_ = true;
  }

  /// What motors `set` said from `since` on was wrong, and so what the filter made of it: their joints'
  /// estimates begin anew there, with the mean that they had.
  void forget(JointSet set, double since) {
    filter_.revise(
        since, [set](CableArmModel::Control& control) { control.unknown |= set; },
        [&](Filter::State& mean, Lower<6>& root) {
          forgetJoints(set, options_.jump_tolerance, options_.unknown_speed, mean, root);
        });
    jump_.reset();
  }

  /// q_kin as the motors that are known say, with `reference` in place of the others.
  Vector3d kinematicGiven(const Vector3d& kinematic, const Vector3d& reference) const {
    const JointSet unknown = watch_.unknown();
    if (unknown == 0 || !reference.allFinite()) return kinematic;
    return cables_.given(kinematic, unknown, reference);
  }

  /// The same at an earlier time, with the estimate of that time; nothing outside the memory.
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

  /// q_kin with the slow errors of the transmission that the filter includes.
  Vector3d corrected(const Vector3d& kinematic) const {
    return slow_ ? slow_->corrected(kinematic) : kinematic;
  }

  /// The camera is silent: q_kin at the camera's rate.
  void watchSilence(double t) {
    snapshot_.gate = Gate::kNoCamera;
    if (t - last_kinematic_ >= options_.camera_period) (void)observeKinematics(t);
  }

  /// UKF paper, section V-D: the hard switch, for the motors that are known. False for a time outside the
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

  void beginCamera(double t, double t_arrival, bool images) {
    snapshot_.camera_updated = true;
    snapshot_.camera_images = images;
    ++snapshot_.camera_samples;
    snapshot_.t_cam = t;
    snapshot_.lag = t_arrival - t;
    for (Vector3d* v :
         {&snapshot_.q_link_cam, &snapshot_.q_link_cam_sigma, &snapshot_.tip_in_camera, &snapshot_.tip_cam})
      v->setConstant(kNan);
    snapshot_.tip_in_camera_covariance.setConstant(kNan);
    snapshot_.q_link_true_cam = reference_.at(t, kReferenceHold).value_or(Vector3d::Constant(kNan));
    const auto kinematic = kinematicAt(t);
    snapshot_.tip_kin_cam = kinematic ? arm_.tip(*kinematic) : Vector3d::Constant(kNan);
  }

  void observeImagedTip(const vision::Triangulation& found, const Eigen::Isometry3d& base_from_camera) {
    noise_.pixels().add(found.chi_square);
    const Vector3d tip = cameras_.point(base_from_camera * found.position);
    const Matrix3d turn = base_from_camera.linear();
    const Matrix3d covariance = cameras_.covariance(turn * found.covariance * turn.transpose());
    observeTip(tip, noise_.ofImagedTip(tip, covariance), noise_.pixels().ratio() * covariance);
  }

  /// A tip in frame 0 becomes q_cam and passes the gate, or does not. `covariance` of its error, `white` of
  /// the part that is new in each frame.
  void observeTip(const Vector3d& tip, const Matrix3d& covariance, const Matrix3d& white) {
    const double t = snapshot_.t_cam;
    snapshot_.tip_cam = tip;
    const auto kinematic = kinematicAt(t);
    const auto state = filter_.at(t);
    if (!started_ || !kinematic || !state) {
      snapshot_.gate = Gate::kNoCamera;
      return;
    }
    auto seen = observeJoints(arm_, tip, covariance, *kinematic);
    if (!seen) {
      snapshot_.gate = Gate::kUnreachable;
      return;
    }
    const Filter::State mean = (*state)->mean();
    seen->covariance = noise_.ofJoints(*seen, Vector3d(mean(1), mean(3), mean(5)));
    snapshot_.q_link_cam = seen->position;
    snapshot_.q_link_cam_sigma = seen->covariance.diagonal().cwiseSqrt();
    if (const JointSet frozen = watch_.see(t, seen->position, seen->covariance, *kinematic); frozen != 0)
      forgetFrozen(frozen);
    const Lower<3> root = rootOf(seen->covariance);
    snapshot_.nis = filter_.peek(t, positions_, seen->position, root)->nis;  // the state at t is there
    Vector3d y = seen->position;
    std::optional<TransmissionEstimator::Observation> slow;
    if (slow_ && watch_.unknown() == 0) {
      slow = slowObservation(t, tip, white, mean, *kinematic);
      snapshot_.nis = slow_->innovation(*slow).nis;
      y -= slow_->cameraError(*slow);
    }
    const bool accepted = accept(t, snapshot_.nis, *seen, *kinematic);
    snapshot_.gate = accepted ? Gate::kOpen : Gate::kJump;
    if (!accepted) return;
    if (slow) learnTransmission(*slow, *kinematic);
    if (!filter_.update(t, positions_, y, root)) {
      snapshot_.gate = Gate::kNoCamera;
      return;
    }
    nis_.add(snapshot_.nis);
    last_seen_ = std::max(last_seen_, t);
  }

  TransmissionEstimator::Observation slowObservation(double t, const Vector3d& tip, const Matrix3d& white,
                                                     const Filter::State& mean,
                                                     const Vector3d& kinematic) const {
    return {t,
            tip,
            white,
            Vector3d(mean(0), mean(2), mean(4)),
            Vector3d(mean(1), mean(3), mean(5)),
            motors_.transmission().linkTravel(kinematic)};
  }

  /// Takes an observation of the slow errors and, where the correction changes, moves the joints' estimate
  /// with it from the exposure on.
  void learnTransmission(const TransmissionEstimator::Observation& seen, const Vector3d& kinematic) {
    const MotorCorrection before = slow_->correction();
    slow_->add(seen);
    const MotorCorrection now = slow_->correction();
    if (now == before) return;
    const Vector3d shift = slow_->shift(kinematic, before, now);
    filter_.revise(
        seen.t, [&now](CableArmModel::Control& control) { control.correction = now; },
        [&shift](Filter::State& mean, Lower<6>&) {
          for (int joint = 0; joint < 3; ++joint) mean(2 * joint) += shift(joint);
        });
  }

  void forgetFrozen(JointSet frozen) {
    snapshot_.motor_failed = watch_.faults();
    for (int motor = 0; motor < 3; ++motor)
      if (contains(frozen, motor)) forget(1U << motor, watch_.stillSince(motor));
  }

  /// The jump gate's opinion. Without motor j, nothing but the camera knows q_j: its path is judged by
  /// itself.
  bool accept(double t, double nis, const JointObservation& seen, const Vector3d& kinematic) {
    const JointSet unknown = watch_.unknown();
    if (unknown == 0) return jump_.accept(t, nis, seen.position - kinematic, seen.covariance);
    Vector3d path = seen.position - kinematicGiven(kinematic, seen.position);
    Vector3d drift = options_.jump_drift, tolerance = options_.jump_tolerance;
    for (int joint = 0; joint < 3; ++joint) {
      if (!contains(unknown, joint)) continue;
      path(joint) = seen.position(joint);
      drift(joint) = options_.unknown_speed(joint);
      tolerance(joint) = std::numeric_limits<double>::infinity();
    }
    return jump_.accept(t, nis, path, seen.covariance, drift, tolerance);
  }

  /// A sample that could not be observed, nor q_kin at its time, is no sign of life: watchSilence() goes on.
  void endCamera() {
    if (snapshot_.gate == Gate::kOpen || observeKinematics(snapshot_.t_cam))
      last_camera_ = snapshot_.t;
    else if (started_)
      ++snapshot_.late_dropped;
    snapshot_.nis_mean = nis_.mean();
    snapshot_.nis_consistent = nis_.consistent();
    if (started_) showEstimate();
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
    view_.show(filter_.mean(), covariance, motors_, watch_, snapshot_);
  }

  void pairReference() {
    if (!reference_pending_ || !started_ || std::abs(reference_time_ - snapshot_.t) > kSameTime) return;
    reference_pending_ = false;
    snapshot_.reference_paired = true;
    const Vector3d error = snapshot_.q_link_ukf - snapshot_.q_link_true;
    snapshot_.nees = error.dot(view_.positionCovariance().llt().solve(error));
  }

  robot::Description numbers_;  ///< robot_ with those effects that are numbers in them
  CameraReading cameras_;
  robot::ArmKinematics arm_;
  EncoderWatch watch_;
  MotorSide motors_;
  PartialKinematics cables_;
  std::optional<StereoTip> stereo_;
  Filter filter_;
  std::optional<TransmissionEstimator> slow_;  ///< of the augmented filter
  EstimateView view_;
  const JointMeasurement positions_ = positionsOnly();
  CameraNoise noise_;
  JumpGate jump_;
  estimation::ConsistencyWindow nis_;
  TimeSeries reference_;
  Snapshot snapshot_;
  RememberedCables cables_before_;
  double last_camera_ = 0.0, last_kinematic_ = 0.0;  ///< by the motors' clock at arrival [s]
  double last_seen_ = 0.0;                           ///< exposure of the newest tip that was accepted [s]
  double reference_time_ = 0.0;
  bool started_ = false, reference_pending_ = false;
};

TrackingPipeline::TrackingPipeline(const robot::Description& robot, std::optional<vision::StereoRig> rig,
                                   const vision::MarkerOptions& marker, const TrackingOptions& options)
    : impl_(std::make_unique<Impl>(robot, std::move(rig), marker, options)) {}
TrackingPipeline::~TrackingPipeline() = default;
TrackingPipeline::TrackingPipeline(TrackingPipeline&&) noexcept = default;
TrackingPipeline& TrackingPipeline::operator=(TrackingPipeline&&) noexcept = default;

void TrackingPipeline::setRegistration(const Eigen::Isometry3d& base_from_camera) {
  impl_->setRegistration(base_from_camera);
}
const std::optional<Eigen::Isometry3d>& TrackingPipeline::registration() const {
  return impl_->base_from_camera_;
}
void TrackingPipeline::setMotorFailed(int motor, bool failed) { impl_->declare(motor, failed); }
const Snapshot& TrackingPipeline::step(const Sample& sample) { return impl_->step(sample); }
const Snapshot& TrackingPipeline::snapshot() const { return impl_->snapshot(); }
void TrackingPipeline::reset() { impl_->reset(); }
const robot::Description& TrackingPipeline::robot() const { return impl_->robot_; }
const std::optional<vision::StereoRig>& TrackingPipeline::rig() const { return impl_->rig_; }
const TrackingOptions& TrackingPipeline::options() const { return impl_->options_; }

}  // namespace capstan::tracking
