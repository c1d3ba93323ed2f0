#include <limits>

#include "core/tracking/pipeline_impl.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using estimation::Lower;

constexpr double kReferenceHold =
    2.5e-3;                        // [s], how long the newest reference stands for what comes after it
constexpr double kAlongRay = 0.3;  // [m], much more than the filter's own standard deviation
constexpr double kKinematicsReach = 0.05;  // [m], more than transmission kinematics err at a wrong radius
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void TrackingPipeline::Impl::take(const StereoFrame& frame) {
  if (!stereo_) return;
  beginCamera(exposureOf(frame.t), frame.t_arrival, true);
  snapshot_.view_blocked = frame.blocked;
  std::optional<Vector3d> expected;
  if (options_.roi_search && base_from_camera_ && snapshot_.tip_kin_cam.allFinite())
    expected = base_from_camera_->inverse() * cameras_.measured(snapshot_.tip_kin_cam);
  stereo_->find(frame, expected);
  snapshot_.marker = stereo_->markers();
  if ((snapshot_.gate = stereo_->gate()) == Gate::kOpen) {
    const vision::Triangulation tip = stereo_->triangulate();
    if (!tip.found() || std::abs(tip.epipolar_residual) > options_.epipolar_limit) {
      snapshot_.gate = areExchanged(tip) ? Gate::kExchanged : Gate::kJump;
    } else {
      snapshot_.tip_in_camera = tip.position;
      snapshot_.tip_in_camera_covariance = tip.covariance;
      if (base_from_camera_)
        observeImagedTip(tip, *base_from_camera_);
      else
        snapshot_.gate = Gate::kUnregistered;
    }
  } else if (options_.one_camera == OneCamera::kRay && base_from_camera_ &&
             snapshot_.gate != Gate::kBothLost) {
    const int side = snapshot_.gate == Gate::kLeftLost ? 1 : 0;
    observeRay(stereo_->ray(side), *base_from_camera_);
  }
  endCamera();
}

/// Exchanged images have a negative disparity: their rays meet behind the cameras, while those of the images
/// put back meet where the motors say that the tip is.
bool TrackingPipeline::Impl::areExchanged(const vision::Triangulation& tip) const {
  if (tip.fault != vision::TriangulationFault::kBehindCamera) return false;
  const vision::Triangulation back = stereo_->triangulateExchanged();
  if (!back.found() || std::abs(back.epipolar_residual) > options_.epipolar_limit) return false;
  if (!base_from_camera_ || !snapshot_.tip_kin_cam.allFinite()) return true;
  const Vector3d expected = base_from_camera_->inverse() * cameras_.measured(snapshot_.tip_kin_cam);
  return (back.position - expected).norm() < kKinematicsReach;
}

void TrackingPipeline::Impl::take(const TipSample& sample) {
  beginCamera(exposureOf(sample.t), sample.t_arrival, false);
  snapshot_.gate = Gate::kBothLost;
  if (sample.position.allFinite()) {
    const Vector3d tip = cameras_.point(sample.position);
    observeTip(tip, noise_.ofTip(tip), options_.tip_sigma.cwiseAbs2().asDiagonal());
  }
  endCamera();
}

double TrackingPipeline::Impl::exposureOf(double stamp) const {
  return cameras_.time(stamp) - options_.camera_delay - (slow_ ? slow_->delay() : 0.0);
}

double TrackingPipeline::Impl::clockSigma() const {
  return slow_ ? slow_->clockSigma() : options_.camera_clock_sigma;
}

void TrackingPipeline::Impl::beginCamera(double t, double t_arrival, bool images) {
  snapshot_.camera_updated = true;
  snapshot_.camera_images = images;
  snapshot_.ray_used = false;
  ++snapshot_.camera_samples;
  snapshot_.t_cam = t;
  snapshot_.latency = t_arrival - t;
  for (Vector3d* v : {&snapshot_.q_link_cam, &snapshot_.q_link_cam_sigma, &snapshot_.tip_in_camera,
                      &snapshot_.tip_cam, &snapshot_.innovation, &snapshot_.innovation_sigma})
    v->setConstant(kNan);
  snapshot_.tip_in_camera_covariance.setConstant(kNan);
  snapshot_.q_link_true_cam = reference_.at(t, kReferenceHold).value_or(Vector3d::Constant(kNan));
  const auto kinematic = kinematicAt(t);
  snapshot_.tip_kin_cam = kinematic ? arm_.tip(*kinematic) : Vector3d::Constant(kNan);
}

void TrackingPipeline::Impl::observeImagedTip(const vision::Triangulation& found,
                                              const Eigen::Isometry3d& base_from_camera) {
  noise_.pixels().add(found.chi_square);
  const Vector3d tip = cameras_.point(base_from_camera * found.position);
  const Matrix3d rotation = base_from_camera.linear();
  const Matrix3d covariance = cameras_.covariance(rotation * found.covariance * rotation.transpose());
  observeTip(tip, noise_.ofImagedTip(tip, covariance), noise_.pixels().ratio() * covariance);
}

void TrackingPipeline::Impl::observeTip(const Vector3d& tip, const Matrix3d& covariance,
                                        const Matrix3d& white) {
  const double t = snapshot_.t_cam;
  snapshot_.tip_cam = tip;
  const auto kinematic = kinematicAt(t);
  const auto state = filter_.at(t);
  if (!started_ || !kinematic || !state) {
    snapshot_.gate = started_ && t < snapshot_.t ? Gate::kLate : Gate::kNoCamera;
    return;
  }
  auto seen = observeJoints(arm_, tip, covariance, *kinematic);
  if (!seen) {
    snapshot_.gate = Gate::kUnreachable;
    return;
  }
  const Filter::State mean = (*state)->mean();
  seen->covariance = noise_.ofJoints(*seen, Vector3d(mean(1), mean(3), mean(5)), clockSigma());
  snapshot_.q_link_cam = seen->position;
  snapshot_.q_link_cam_sigma = seen->covariance.diagonal().cwiseSqrt();
  if (const JointSet frozen = watch_.see(t, seen->position, seen->covariance, *kinematic); frozen != 0)
    forgetFrozen(frozen);
  const Lower<3> root = rootOf(seen->covariance);
  std::optional<TransmissionEstimator::Observation> slow;
  if (slow_) {
    slow = slowObservation(t, tip, white, mean, *kinematic);
    seen->position -= slow_->residual(*slow);
  }
  const bool whole = slow && watch_.unknown() == 0;
  const auto of_tip = whole ? std::optional(slow_->innovation(*slow)) : std::nullopt;
  const auto of_joints =
      whole ? std::nullopt : std::optional(*filter_.peek(t, positions_, seen->position, root));
  snapshot_.nis = whole ? of_tip->nis : of_joints->nis;
  const bool accepted = accept(t, snapshot_.nis, *seen, corrected(*kinematic));
  snapshot_.gate = accepted ? Gate::kOpen : Gate::kJump;
  if (!accepted) return;
  if (whole && t >= corrected_since_) learnTransmission(*slow);
  if (!filter_.update(t, positions_, seen->position, root)) {
    snapshot_.gate = Gate::kLate;
    return;
  }
  if (whole != nis_of_transmission_) nis_.reset();
  nis_of_transmission_ = whole;
  nis_.add(snapshot_.nis);
  if (whole)
    showInnovation(*of_tip, mean);
  else
    showInnovation(of_joints->innovation, of_joints->root * of_joints->root.transpose());
  last_seen_ = std::max(last_seen_, t);
}

// The point of the ray nearest to the estimate, with a variance along the ray that leaves that coordinate to
// the filter: its innovation has two numbers.
void TrackingPipeline::Impl::observeRay(const vision::CameraRay& ray,
                                        const Eigen::Isometry3d& base_from_camera) {
  const double t = snapshot_.t_cam;
  const auto kinematic = kinematicAt(t);
  const auto state = filter_.at(t);
  if (!started_ || !kinematic || !state || watch_.unknown() != 0) return;
  const Filter::State mean = (*state)->mean();
  const Vector3d q(mean(0), mean(2), mean(4)), speed(mean(1), mean(3), mean(5));
  const Vector3d expected = base_from_camera.inverse() * cameras_.measured(arm_.tip(q));
  const Matrix3d rotation = base_from_camera.linear();
  const Vector3d tip = cameras_.point(base_from_camera * ray.nearest(expected));
  const Matrix3d covariance = cameras_.covariance(rotation * ray.covariance(expected) * rotation.transpose());
  auto seen = observeJoints(arm_, tip, noise_.ofImagedTip(tip, covariance), q);
  if (!seen) return;
  seen->covariance = noise_.ofJoints(*seen, speed, clockSigma());
  const Vector3d direction = rotation * ray.direction;
  std::optional<TransmissionEstimator::Observation> slow;
  if (slow_) {
    slow = slowObservation(t, tip, noise_.pixels().ratio() * covariance, mean, *kinematic);
    slow->open = kAlongRay * kAlongRay * direction * direction.transpose();
    seen->position -= slow_->residual(*slow);
  }
  const Vector3d along = arm_.tipJacobian(q).inverse() * direction;
  seen->covariance += kAlongRay * kAlongRay * along * along.transpose();
  const Lower<3> root = rootOf(seen->covariance);
  snapshot_.ray_nis =
      slow ? slow_->innovation(*slow).nis : filter_.peek(t, positions_, seen->position, root)->nis;
  if (!ray_jump_.accept(t, snapshot_.ray_nis, seen->position - corrected(*kinematic), seen->covariance))
    return;
  if (slow && t >= corrected_since_) {
    const MotorCorrection before = slow_->correction();
    slow_->addRay(*slow);
    correctSince(t, before);
  }
  snapshot_.ray_used = filter_.update(t, positions_, seen->position, root).has_value();
}

void TrackingPipeline::Impl::showInnovation(const Vector3d& innovation, const Matrix3d& covariance) {
  snapshot_.innovation = innovation;
  snapshot_.innovation_sigma = covariance.diagonal().cwiseSqrt();
}

void TrackingPipeline::Impl::showInnovation(const TransmissionEstimator::Innovation& tip,
                                            const Filter::State& mean) {
  const Matrix3d joints_from_tip = arm_.tipJacobian(Vector3d(mean(0), mean(2), mean(4))).inverse();
  showInnovation(Vector3d(joints_from_tip * tip.value),
                 joints_from_tip * tip.covariance * joints_from_tip.transpose());
}

TransmissionEstimator::Observation TrackingPipeline::Impl::slowObservation(double t, const Vector3d& tip,
                                                                           const Matrix3d& white,
                                                                           const Filter::State& mean,
                                                                           const Vector3d& kinematic) const {
  return {t,
          tip,
          white,
          Vector3d(mean(0), mean(2), mean(4)),
          Vector3d(mean(1), mean(3), mean(5)),
          motors_.transmission().linkTravel(kinematic),
          Matrix3d::Zero()};
}

void TrackingPipeline::Impl::learnTransmission(const TransmissionEstimator::Observation& seen) {
  const MotorCorrection before = slow_->correction();
  slow_->add(seen);
  correctSince(seen.t, before);
}

void TrackingPipeline::Impl::correctSince(double t, const MotorCorrection& before) {
  const MotorCorrection now = slow_->correction();
  const auto kinematic = motors_.kinematicAt(t, options_.restart_gap);
  if (now == before || !kinematic) return;
  const Vector3d shift = slow_->shift(*kinematic, before, now);
  filter_.revise(
      t, [&now](CableArmModel::Control& control) { control.correction = now; },
      [&shift](Filter::State& mean, Lower<6>&) {
        for (int joint = 0; joint < 3; ++joint) mean(2 * joint) += shift(joint);
      });
  cables_before_.correct(now);
  corrected_since_ = t;
}

void TrackingPipeline::Impl::forgetFrozen(JointSet frozen) {
  snapshot_.motor_failed = watch_.faults();
  for (int motor = 0; motor < 3; ++motor)
    if (contains(frozen, motor)) forget(1U << motor, watch_.stillSince(motor));
}

bool TrackingPipeline::Impl::accept(double t, double nis, const JointObservation& seen,
                                    const Vector3d& kinematic) {
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

void TrackingPipeline::Impl::endCamera() {
  if (snapshot_.gate == Gate::kOpen || snapshot_.ray_used || observeKinematics(snapshot_.t_cam))
    last_camera_ = snapshot_.t;
  else if (started_)
    ++snapshot_.late_dropped;
  if (snapshot_.gate == Gate::kLate) last_late_ = snapshot_.t;
  snapshot_.nis_mean = nis_.mean();
  snapshot_.nis_consistent = nis_.consistent();
  if (started_) showEstimate();
}

}  // namespace capstan::tracking
