#include "core/tracking/pipeline.h"

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/estimation/consistency.h"
#include "core/estimation/delayed_filter.h"
#include "core/estimation/occlusion_gate.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/cable.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/joint_observation.h"
#include "core/tracking/jump_gate.h"
#include "core/tracking/motor_side.h"
#include "core/tracking/stereo_tip.h"
#include "core/tracking/time_series.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using estimation::Lower;
using JointMeasurement = estimation::LinearMeasurement<6, 3>;
using Filter = estimation::DelayedFilter<CableArmModel, JointMeasurement>;

constexpr double kMotorRate = 1000.0;  // [1/s], sizes the memory
constexpr double kSameTime = 0.5e-3;   // [s], a reference and a motor sample this close speak of one time
constexpr double kReferenceHold =
    2.5e-3;  // [s], how long the newest reference stands for what comes after it
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// UKF paper (10): states q1 dq1 q2 dq2 q3 dq3, the camera sees positions.
JointMeasurement positionsOnly() {
  JointMeasurement measurement;
  for (int joint = 0; joint < 3; ++joint) measurement.h(joint, 2 * joint) = 1.0;
  return measurement;
}

Lower<6> diagonalOf(const Vector3d& position, const Vector3d& velocity) {
  Lower<6> root = Lower<6>::Zero();
  for (int joint = 0; joint < 3; ++joint) {
    root(2 * joint, 2 * joint) = position(joint);
    root(2 * joint + 1, 2 * joint + 1) = velocity(joint);
  }
  return root;
}

Lower<3> rootOf(const Matrix3d& covariance) { return Lower<3>(covariance.llt().matrixL()); }

std::size_t memorySize(const TrackingOptions& options) {
  return static_cast<std::size_t>(std::ceil(1.25 * kMotorRate * options.memory)) + 64;
}

Snapshot emptySnapshot() {
  Snapshot s;
  for (Vector3d* v :
       {&s.q_motor, &s.dq_motor, &s.q_link_kin, &s.q_link_cam, &s.q_link_cam_sigma, &s.q_link_ukf,
        &s.dq_link_ukf, &s.q_link_ukf_sigma, &s.q_link_true, &s.q_link_true_cam, &s.cable_stretch,
        &s.cable_tension, &s.tip_in_camera, &s.tip_cam, &s.tip_kin_cam, &s.tip_kin, &s.tip_ukf})
    v->setConstant(kNan);
  s.tip_in_camera_covariance.setConstant(kNan);
  s.tip_ukf_covariance.setConstant(kNan);
  s.t_cam = s.lag = s.nis = s.nis_mean = s.nees = kNan;
  return s;
}

}  // namespace

class TrackingPipeline::Impl {
 public:
  Impl(const robot::Description& robot, std::optional<vision::StereoRig> rig,
       const vision::MarkerOptions& marker, const TrackingOptions& options)
      : robot_(robot),
        rig_(std::move(rig)),
        options_(options),
        arm_(robot),
        motors_(robot, options.differentiation_time, memorySize(options)),
        filter_(CableArmModel(robot), diagonalOf(options.position_noise, options.velocity_noise),
                static_cast<int>(memorySize(options))),
        jump_(estimation::chiSquareQuantile(3, options.gate_probability), options.jump_samples,
              options.jump_drift, options.jump_tolerance),
        nis_(3, options.nis_window),
        reference_(memorySize(options)),
        snapshot_(emptySnapshot()) {
    if (rig_) stereo_.emplace(*rig_, marker, options.full_frame_search);
  }

  void reset() {
    motors_.clear();
    reference_.clear();
    jump_.reset();
    nis_.reset();
    started_ = reference_pending_ = false;
    snapshot_ = emptySnapshot();
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
    const MotorSide::Taken taken = motors_.take(sample);
    if (taken == MotorSide::Taken::kRefused) {
      ++snapshot_.motor_refused;
      return;
    }
    if (taken == MotorSide::Taken::kAnew) {
      reference_.clear();
      started_ = reference_pending_ = false;
    }
    snapshot_.t = sample.t;
    snapshot_.motor_updated = true;
    ++snapshot_.motor_samples;
    if (!started_ || sample.t - before > options_.restart_gap)
      start(sample.t);
    else
      filter_.advance(sample.t, control());
    if (sample.t - last_camera_ >= options_.missing_after * options_.camera_period) watchSilence(sample.t);
    showMotors();
    showEstimate();
    pairReference();
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
    beginCamera(frame.t, frame.t_arrival, true);
    std::optional<Vector3d> expected;
    if (options_.roi_search && base_from_camera_ && snapshot_.tip_kin_cam.allFinite())
      expected = base_from_camera_->inverse() * snapshot_.tip_kin_cam;
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
          observeTip(*base_from_camera_ * tip.position,
                     base_from_camera_->linear() * tip.covariance * base_from_camera_->linear().transpose());
        else
          snapshot_.gate = Gate::kUnregistered;
      }
    }
    endCamera();
  }

  void take(const TipSample& sample) {
    beginCamera(sample.t, sample.t_arrival, false);
    snapshot_.gate = Gate::kBothLost;
    if (sample.position.allFinite())
      observeTip(sample.position, options_.tip_sigma.cwiseAbs2().asDiagonal().toDenseMatrix());
    endCamera();
  }

  void start(double t) {
    Filter::State mean = Filter::State::Zero();
    const Vector3d speed = motors_.transmission().jointVelocityFromMotor(motors_.velocity());
    for (int joint = 0; joint < 3; ++joint) {
      mean(2 * joint) = motors_.kinematic()(joint);
      mean(2 * joint + 1) = speed(joint);
    }
    filter_.reset(t, mean, diagonalOf(options_.initial_position_sigma, options_.initial_velocity_sigma),
                  control());
    jump_.reset();
    last_camera_ = last_kinematic_ = t;
    started_ = true;
  }

  CableArmModel::Control control() const { return {motors_.position(), motors_.velocity()}; }

  /// The camera is silent: q_kin at the camera's rate.
  void watchSilence(double t) {
    snapshot_.gate = Gate::kNoCamera;
    if (t - last_kinematic_ >= options_.camera_period) (void)observeKinematics(t);
  }

  /// UKF paper, section V-D: the hard switch. False for a time outside the memory.
  bool observeKinematics(double t) {
    const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
    if (!started_ || !kinematic) return false;
    const Lower<3> root = Lower<3>(options_.kinematic_sigma.asDiagonal());
    const auto report = filter_.update(t, positions_, *kinematic, root);
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
    const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
    snapshot_.tip_kin_cam = kinematic ? arm_.tip(*kinematic) : Vector3d::Constant(kNan);
  }

  /// A tip in frame 0 becomes q_cam and passes the gate, or does not.
  void observeTip(const Vector3d& tip, const Matrix3d& covariance) {
    const double t = snapshot_.t_cam;
    snapshot_.tip_cam = tip;
    const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
    if (!started_ || !kinematic) {
      snapshot_.gate = Gate::kNoCamera;
      return;
    }
    const auto seen = observeJoints(arm_, tip, covariance, *kinematic, options_.camera_sigma_floor);
    if (!seen) {
      snapshot_.gate = Gate::kUnreachable;
      return;
    }
    snapshot_.q_link_cam = seen->position;
    snapshot_.q_link_cam_sigma = seen->covariance.diagonal().cwiseSqrt();
    const Lower<3> root = rootOf(seen->covariance);
    const auto expected = filter_.peek(t, positions_, seen->position, root);
    if (!expected) {
      snapshot_.gate = Gate::kNoCamera;
      return;
    }
    snapshot_.nis = expected->nis;
    const bool accepted = jump_.accept(t, expected->nis, seen->position - *kinematic, seen->covariance);
    snapshot_.gate = accepted ? Gate::kOpen : Gate::kJump;
    if (!accepted) return;
    if (filter_.update(t, positions_, seen->position, root))
      nis_.add(expected->nis);
    else
      snapshot_.gate = Gate::kNoCamera;
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

  void showMotors() {
    snapshot_.q_motor = motors_.position();
    snapshot_.dq_motor = motors_.velocity();
    snapshot_.q_link_kin = motors_.kinematic();
    snapshot_.tip_kin = arm_.tip(motors_.kinematic());
  }

  void showEstimate() {
    const auto& mean = filter_.mean();
    const auto covariance = filter_.covariance();
    for (int joint = 0; joint < 3; ++joint) {
      snapshot_.q_link_ukf(joint) = mean(2 * joint);
      snapshot_.dq_link_ukf(joint) = mean(2 * joint + 1);
      for (int other = 0; other < 3; ++other)
        position_covariance_(joint, other) = covariance(2 * joint, 2 * other);
    }
    snapshot_.q_link_ukf_sigma = position_covariance_.diagonal().cwiseSqrt();
    snapshot_.rescues = filter_.rescues();
    const robot::Transmission& cables = motors_.transmission();
    snapshot_.cable_stretch =
        Vector3d(cables.motorTravel(motors_.position())) - Vector3d(cables.linkTravel(snapshot_.q_link_ukf));
    const Vector3d rate = Vector3d(cables.motorTravel(motors_.velocity())) -
                          Vector3d(cables.linkTravelRate(snapshot_.dq_link_ukf));
    for (int joint = 0; joint < 3; ++joint) {
      const robot::Drive& drive = robot_.drives[static_cast<std::size_t>(joint)];
      snapshot_.cable_tension(joint) =
          robot::cableForce(drive.cable_stiffness, drive.cable_exponent, drive.cable_damping,
                            snapshot_.cable_stretch(joint), rate(joint));
    }
    const Matrix3d jacobian = arm_.tipJacobian(snapshot_.q_link_ukf);
    snapshot_.tip_ukf = arm_.tip(snapshot_.q_link_ukf);
    snapshot_.tip_ukf_covariance = jacobian * position_covariance_ * jacobian.transpose();
  }

  void pairReference() {
    if (!reference_pending_ || !started_ || std::abs(reference_time_ - snapshot_.t) > kSameTime) return;
    reference_pending_ = false;
    snapshot_.reference_paired = true;
    const Vector3d error = snapshot_.q_link_ukf - snapshot_.q_link_true;
    snapshot_.nees = error.dot(position_covariance_.llt().solve(error));
  }

  robot::ArmKinematics arm_;
  MotorSide motors_;
  std::optional<StereoTip> stereo_;
  Filter filter_;
  const JointMeasurement positions_ = positionsOnly();
  JumpGate jump_;
  estimation::ConsistencyWindow nis_;
  TimeSeries reference_;
  Snapshot snapshot_;
  Matrix3d position_covariance_ = Matrix3d::Zero();
  double last_camera_ = 0.0, last_kinematic_ = 0.0;  ///< by the motors' clock at arrival [s]
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
  impl_->base_from_camera_ = base_from_camera;
}
const std::optional<Eigen::Isometry3d>& TrackingPipeline::registration() const {
  return impl_->base_from_camera_;
}
const Snapshot& TrackingPipeline::step(const Sample& sample) { return impl_->step(sample); }
const Snapshot& TrackingPipeline::snapshot() const { return impl_->snapshot(); }
void TrackingPipeline::reset() { impl_->reset(); }
const robot::Description& TrackingPipeline::robot() const { return impl_->robot_; }
const std::optional<vision::StereoRig>& TrackingPipeline::rig() const { return impl_->rig_; }
const TrackingOptions& TrackingPipeline::options() const { return impl_->options_; }

}  // namespace capstan::tracking
