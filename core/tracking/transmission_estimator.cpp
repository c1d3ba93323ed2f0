#include "core/tracking/transmission_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Prior = estimation::SparseRegression<14, 6>::Prior;

/// Of the cameras' scale: what a calibration leaves in focal length and base line, and what a wrong one has.
constexpr double kScaleSigma = 0.01, kWrongScaleSigma = 0.05;

Prior priorOf(const TrackingOptions& options) {
  const Vector3d one = Vector3d::Ones();
  Prior prior;
  prior.sigma << options.scale_sigma, options.offset_sigma * one;
  prior.inclusion_probability << options.scale_probability * one, options.offset_probability * one;
  const double turn = std::max(options.registration_turn_sigma, 1e-9);
  const double shift = std::max(options.registration_shift_sigma, 1e-9);
  prior.usual_sigma << turn * one, shift * one, kScaleSigma, options.camera_delay_sigma;
  prior.unusual_sigma << std::max(turn, options.camera_moved_turn_sigma) * one,
      std::max(shift, options.camera_moved_shift_sigma) * one, kWrongScaleSigma, options.camera_delay_sigma;
  prior.unusual_probability = options.camera_moved_probability;
  return prior;
}

Matrix3d cross(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a(2), a(1), a(2), 0.0, -a(0), -a(1), a(0), 0.0;
  return m;
}

}  // namespace

TransmissionEstimator::TransmissionEstimator(const robot::Description& robot, const TrackingOptions& options)
    : arm_(robot),
      transmission_(robot),
      homing_(robot::homingOf(robot)),
      hard_stop_(arm_.tip(homing_)),
      options_(options),
      regression_(priorOf(options)),
      white_(options.pixel_noise_memory, 1.5 * options.camera_period),
      innovations_(options.nis_window) {
  const Matrix3d coupling = transmission_.coupling();
  joints_from_travel_ = coupling.inverse() * Vector3d(transmission_.linkRadius()).cwiseInverse().asDiagonal();
  publish();
}

void TransmissionEstimator::reset() {
  regression_.reset();
  white_.reset();
  innovations_.reset();
  started_ = false;
  publish();
}

Vector3d TransmissionEstimator::travelOf(const Vector3d& q_kin) const {
  return transmission_.linkTravel(q_kin);  // q_kin is where the link side has travelled as far as the motors
}

Eigen::Matrix<double, 3, 6> TransmissionEstimator::jointSensitivity(const Vector3d& travel) const {
  Eigen::Matrix<double, 3, 6> g;
  g << joints_from_travel_ * travel.asDiagonal(), joints_from_travel_;
  return g;
}

auto TransmissionEstimator::sensitivity(const Observation& seen, const Matrix3d& jacobian) const
    -> Sensitivity {
  Sensitivity h;
  h << jacobian * jointSensitivity(seen.travel), -cross(seen.tip - hard_stop_), Matrix3d::Identity(),
      seen.tip - hard_stop_, -jacobian * seen.dq;
  return h;
}

Matrix3d TransmissionEstimator::cableNoise(const Matrix3d& jacobian, double times) const {
  return times * jacobian * options_.cable_error.cwiseAbs2().asDiagonal() * jacobian.transpose();
}

auto TransmissionEstimator::innovation(const Observation& seen) const -> Innovation {
  const Matrix3d jacobian = arm_.tipJacobian(seen.q);
  const Sensitivity h = sensitivity(seen, jacobian);
  Innovation innovation;
  innovation.value =
      seen.tip - arm_.tip(seen.q) - h.rightCols<kCamera>() * regression_.mean().tail<kCamera>();
  const Matrix3d predicted =
      h * covariance_ * h.transpose() + white_.value(seen.noise) + cableNoise(jacobian, 1.0);
  innovation.nis =
      innovation.value.dot(Vector3d(innovations_.value(predicted).llt().solve(innovation.value)));
  return innovation;
}

void TransmissionEstimator::add(const Observation& seen) {
  const Matrix3d jacobian = arm_.tipJacobian(seen.q);
  const Sensitivity h = sensitivity(seen, jacobian);
  const Innovation innovation = this->innovation(seen);
  innovations_.add(innovation.value, innovation.nis);
  white_.add(seen.t, innovation.value, seen.noise);
  if (started_) regression_.forget(std::exp(-std::max(seen.t - newest_, 0.0) / options_.transmission_memory));
  newest_ = started_ ? std::max(newest_, seen.t) : seen.t;
  started_ = true;
  const Vector3d z = innovation.value + h * regression_.mean();
  const double times = 2.0 * options_.cable_error_time / options_.camera_period;
  const Matrix3d noise = white_.value(seen.noise) + cableNoise(jacobian, times);
  if (!regression_.add<3>(h, z, noise)) return;
  const auto before = included();
  regression_.select();
  if (included() != before) innovations_.reset();  // those of another model say nothing of this one's
  publish();
}

unsigned TransmissionEstimator::included() const {
  unsigned set = regression_.unusualProbability() > 0.5 ? 1U << kOptional : 0U;
  for (int i = 0; i < kOptional; ++i)
    if (regression_.included(i)) set |= 1U << i;
  return set;
}

void TransmissionEstimator::age(double t) {
  if (!started_ || t <= newest_) return;
  covariance_ = regression_.covarianceAged(std::exp(-(t - newest_) / options_.transmission_memory));
}

void TransmissionEstimator::publish() {
  covariance_ = regression_.covariance();
  const auto& mean = regression_.mean();
  const auto& included = regression_.inclusionProbability();
  estimate_.scale = mean.head<3>();
  estimate_.offset = mean.segment<3>(3);
  estimate_.scale_sigma = covariance_.diagonal().head<3>().cwiseSqrt();
  estimate_.offset_sigma = covariance_.diagonal().segment<3>(3).cwiseSqrt();
  estimate_.scale_probability = included.head<3>();
  estimate_.offset_probability = included.tail<3>();
  estimate_.camera_rotation = mean.segment<3>(6);
  estimate_.camera_shift = mean.segment<3>(9);
  estimate_.camera_delay = mean(13);
  estimate_.camera_moved_probability = regression_.unusualProbability();
  correction_.scale = estimate_.scale;
  correction_.offset = estimate_.offset.cwiseQuotient(Vector3d(transmission_.motorRadius()));
}

Vector3d TransmissionEstimator::shift(const Vector3d& q_kin, const MotorCorrection& from,
                                      const MotorCorrection& to) const {
  const Vector3d offset = Vector3d(transmission_.motorRadius()).cwiseProduct(to.offset - from.offset);
  return joints_from_travel_ * (travelOf(q_kin).cwiseProduct(to.scale - from.scale) + offset);
}

Vector3d TransmissionEstimator::corrected(const Vector3d& q_kin) const {
  return q_kin + shift(q_kin, {}, correction_);
}

Matrix3d TransmissionEstimator::jointCovariance(const Vector3d& q_kin) const {
  const auto g = jointSensitivity(travelOf(q_kin));
  return g * covariance_.topLeftCorner<6, 6>() * g.transpose();
}

Vector3d TransmissionEstimator::cameraError(const Observation& seen) const {
  const Matrix3d jacobian = arm_.tipJacobian(seen.q);
  const Vector3d error =
      sensitivity(seen, jacobian).rightCols<kCamera>() * regression_.mean().tail<kCamera>();
  const Vector3d joints = jacobian.partialPivLu().solve(error);
  return joints.allFinite() ? joints : Vector3d::Zero();
}

}  // namespace capstan::tracking
