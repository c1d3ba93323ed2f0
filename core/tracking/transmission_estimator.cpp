#include "core/tracking/transmission_estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Regression = estimation::SparseRegression<17, 9>;
using Prior = Regression::Prior;

/// Length of a segment, and its largest length [s].
constexpr double kSegment = 1.0, kLongestSegment = 2.0;
constexpr double kCertain = 0.95;
constexpr double kFound = 0.999;      ///< prior probability of a change that was detected
constexpr double kLead = 5.0;         ///< log odds that one kind of change needs against the others
constexpr double kLongDelay = 0.015;  ///< smallest delay that is subtracted from the stamps [s]
constexpr double kOutlier = 9.0;      ///< upper bound of NIS over its degrees of freedom
constexpr int kIntervals = 30;        ///< in the running mean of the time between observations

Prior priorOf(const TrackingOptions& options) {
  const Vector3d one = Vector3d::Ones();
  Prior prior;
  prior.sigma << options.scale_sigma, options.offset_sigma * one, options.compliance_sigma * one;
  prior.inclusion_probability << options.scale_probability * one, options.offset_probability * one,
      options.compliance_probability * one;
  const double rotation = std::max(options.registration_rotation_sigma, 1e-9);
  const double shift = std::max(options.registration_shift_sigma, 1e-9);
  prior.usual_sigma << rotation * one, shift * one, options.camera_scale_sigma, options.camera_delay_sigma;
  prior.unusual_sigma << std::max(rotation, options.camera_moved_rotation_sigma) * one,
      std::max(shift, options.camera_moved_shift_sigma) * one,
      std::max(options.camera_scale_sigma, options.camera_moved_scale_sigma), options.camera_delay_sigma;
  prior.unusual_probability = options.camera_moved_probability;
  // A wrong pulley radius is common at the start; other errors are included once they are nearly certain.
  prior.enters.tail<7>().setConstant(kCertain);
  prior.highest = TransmissionEstimator::kMostSigmas * prior.sigma;
  prior.lowest = -prior.highest;
  prior.highest.tail<3>().setOnes();  // of 1 − k_e / k_e,true
  prior.lowest.tail<3>().setConstant(1.0 - TransmissionEstimator::kHardest);
  return prior;
}

/// Effect of each kind of change, in units of Regression::sigma(): an encoder that slips moves one cable's
/// zero, cameras that are knocked rotate and shift.
using Changes = std::array<Regression::Vector, 4>;
Changes changesOf(const Regression& regression) {
  Changes changes;
  changes.fill(Regression::Vector::Zero());
  for (std::size_t joint = 0; joint < 3; ++joint) changes[joint](3 + static_cast<int>(joint)) = 1.0;
  changes[3].segment<6>(9) = regression.widestPrecision().segment<6>(9).cwiseInverse();
  return changes;
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
      prior_(priorOf(options)),
      regression_(prior_),
      changes_(regression_.widestPrecision(), changesOf(regression_), options.change_log_odds, kLead),
      white_(options.pixel_noise_memory, 1.5 * options.camera_period, options.camera_clock_sigma),
      period_(options.camera_period) {
  const Matrix3d coupling = transmission_.coupling();
  joints_from_travel_ = coupling.inverse() * Vector3d(transmission_.linkRadius()).cwiseInverse().asDiagonal();
  select();
}

void TransmissionEstimator::reset() {
  changes_.reset();
  prior_ = priorOf(options_);
  regression_ = Regression(prior_);
  misfit_ = 1.0;
  share_.reset();
  delay_ = 0.0;
  period_ = options_.camera_period;
  intervals_ = 0;
  restartClock();
  select();
}

void TransmissionEstimator::restartClock() {
  segment_ = {};
  white_.reset();
  started_ = false;
}

void TransmissionEstimator::forgetCameras() {
  segment_ = {};
  changes_.release(changesOf(regression_).back());
  prior_.unusual_probability = options_.camera_moved_probability;
  regression_.setPrior(prior_.inclusion_probability, prior_.unusual_probability);
  select();
}

Vector3d TransmissionEstimator::travelOf(const Vector3d& q_kin) const {
  return transmission_.linkTravel(q_kin);  // q_kin is where the link side has travelled as far as the motors
}

auto TransmissionEstimator::jointSensitivity(const Vector3d& travel) const
    -> Eigen::Matrix<double, 3, kMotor> {
  Eigen::Matrix<double, 3, kMotor> g;
  g << joints_from_travel_ * travel.asDiagonal(), joints_from_travel_;
  return g;
}

auto TransmissionEstimator::reading(const Observation& seen) const -> Reading {
  const Matrix3d jacobian = arm_.tipJacobian(seen.q);
  const Vector3d stretch = correctedTravel(seen.travel) - Vector3d(transmission_.linkTravel(seen.q));
  Reading reading;
  reading.h << jacobian * jointSensitivity(seen.travel),
      jacobian * joints_from_travel_ * stretch.asDiagonal(), -cross(seen.tip - hard_stop_),
      Matrix3d::Identity(), seen.tip - hard_stop_, -jacobian * seen.dq;
  reading.z = seen.tip - arm_.tip(seen.q) + reading.h * used_;
  reading.white = white_.value(seen.noise, jacobian * seen.dq) + seen.open;
  reading.cables = jacobian * options_.cable_error.cwiseAbs2().asDiagonal() * jacobian.transpose();
  return reading;
}

auto TransmissionEstimator::innovation(const Reading& reading) const -> Innovation {
  Innovation innovation;
  innovation.value = reading.z - reading.h * regression_.mean();
  const Matrix3d slow = reading.h * covariance_ * reading.h.transpose() + reading.cables;
  innovation.covariance = reading.white + share_.value() * slow;
  innovation.nis = innovation.value.dot(Vector3d(innovation.covariance.llt().solve(innovation.value)));
  return innovation;
}

auto TransmissionEstimator::innovation(const Observation& seen) const -> Innovation {
  return innovation(reading(seen));
}

/// Compares innovations with their expected size, with every coefficient present.
void TransmissionEstimator::judgeFit(const Reading& reading) {
  const Vector3d innovation = reading.z - reading.h * widest_mean_;
  const Matrix3d predicted =
      reading.h * widest_covariance_ * reading.h.transpose() + reading.white + reading.cables;
  const double nis = innovation.dot(Vector3d(predicted.llt().solve(innovation))) / 3.0;
  if (std::isfinite(nis)) misfit_ += (std::min(nis, kOutlier) - misfit_) / options_.nis_window;
}

void TransmissionEstimator::addRay(const Observation& seen) {
  if (segment_.count > 0 && seen.t - segment_start_ > kLongestSegment) closeSegment();
  passTime(seen.t);
  accumulate(seen.t, reading(seen));
}

void TransmissionEstimator::add(const Observation& seen) {
  if (segment_.count > 0 && seen.t - segment_start_ > kLongestSegment) closeSegment();
  const Reading reading = this->reading(seen);
  const Innovation innovation = this->innovation(reading);
  white_.add(seen.t, innovation.value, reading.h.col(kDelay), seen.noise);
  share_.add(innovation.nis / 3.0);
  judgeFit(reading);
  passTime(seen.t);
  accumulate(seen.t, reading);
}

void TransmissionEstimator::accumulate(double t, const Reading& reading) {
  if (segment_.count == 0) segment_start_ = t;
  const double times = 2.0 * options_.cable_error_time / period_;
  (void)segment_.add<3>(reading.h, reading.z, reading.white + times * reading.cables, regression_.sigma());
  // The first segments are short: with little information, there is nothing yet to compare a change with.
  const double whole = std::clamp(0.25 * regression_.information().count * period_, period_, kSegment);
  if (segment_.count * period_ >= whole) closeSegment();
}

/// Advances the time to t [s]. While cameras are silent, nothing is forgotten, and the period stays.
void TransmissionEstimator::passTime(double t) {
  const double longest = 2.0 * options_.camera_period, passed = t - newest_;
  if (started_) {
    forgotten_ *= std::exp(-std::clamp(passed, 0.0, longest) / options_.transmission_memory);
    if (passed > 0.0 && passed <= longest) {
      intervals_ = std::min(intervals_ + 1, kIntervals);
      period_ += (passed - period_) / intervals_;
    }
  }
  newest_ = started_ ? std::max(newest_, t) : t;
  started_ = true;
}

void TransmissionEstimator::closeSegment() {
  changes_.forget(forgotten_);
  forgotten_ = 1.0;
  const int change = changes_.close(segment_, 1.0 / std::max(misfit_, 1.0));
  if (change >= 0) expectChange(change);
  segment_ = {};
  select();
  takeOutDelay();
}

/// Subtracts a long delay from the stamps and restarts observations, because their sensitivity −J dq to the
/// delay holds only while the arm's speed is constant over it.
void TransmissionEstimator::takeOutDelay() {
  const double delay = regression_.mean()(kDelay);
  const double sigma = std::sqrt(covariance_(kDelay, kDelay));
  if (std::abs(delay) < std::max(kLongDelay, 3.0 * sigma)) return;
  delay_ += delay;
  changes_.reset();
  select();
}

/// Sets the prior for a detected change: it exists, and only its size is to be estimated.
void TransmissionEstimator::expectChange(int kind) {
  misfit_ = 1.0;
  if (kind < 3)
    prior_.inclusion_probability(3 + kind) = kFound;
  else
    prior_.unusual_probability = kFound;
  regression_.setPrior(prior_.inclusion_probability, prior_.unusual_probability);
}

/// Selects the coefficients, with the information weighted by its goodness of fit.
void TransmissionEstimator::select() {
  Information known = changes_.known();
  known.scale(1.0 / std::max(misfit_, 1.0));
  regression_.select(known);
  Regression::Matrix widest = known.matrix;
  widest.diagonal() += regression_.widestPrecision();
  const Eigen::LLT<Regression::Matrix> root(widest);
  const auto& sigma = regression_.sigma();
  widest_mean_ = sigma.cwiseProduct(root.solve(known.score));
  widest_covariance_ = sigma.asDiagonal() * root.solve(Regression::Matrix::Identity()) * sigma.asDiagonal();
  publish();
}

Vector3d TransmissionEstimator::correctedTravel(const Vector3d& travel) const {
  return travel + used_.head<3>().cwiseProduct(travel) + used_.segment<3>(3);
}

void TransmissionEstimator::age(double t) {
  if (!started_ || t <= newest_) return;
  covariance_ = regression_.covarianceDiscounted(std::exp(-(t - newest_) / options_.transmission_memory));
}

void TransmissionEstimator::publish() {
  covariance_ = regression_.covariance();
  const Regression::Vector mean = regression_.mean();
  const auto& included = regression_.inclusionProbability();
  estimate_.scale = mean.head<3>();
  estimate_.offset = mean.segment<3>(3);
  estimate_.compliance = mean.segment<3>(6);
  estimate_.scale_sigma = covariance_.diagonal().head<3>().cwiseSqrt();
  estimate_.offset_sigma = covariance_.diagonal().segment<3>(3).cwiseSqrt();
  estimate_.compliance_sigma = covariance_.diagonal().segment<3>(6).cwiseSqrt();
  estimate_.scale_probability = included.head<3>();
  estimate_.offset_probability = included.segment<3>(3);
  estimate_.compliance_probability = included.tail<3>();
  estimate_.camera_rotation = mean.segment<3>(9);
  estimate_.camera_shift = mean.segment<3>(12);
  estimate_.camera_scale = mean(15);
  estimate_.camera_delay = delay_ + mean(kDelay);
  estimate_.camera_moved_probability = regression_.unusualProbability();
  estimate_.change_in_question = changes_.inQuestion();
  correction_.scale = estimate_.scale;
  correction_.offset = estimate_.offset.cwiseQuotient(Vector3d(transmission_.motorRadius()));
  used_.setZero();
  used_.head<kMotor>() = mean.head<kMotor>();
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
  Eigen::Matrix<double, kMotor, kMotor> errors = covariance_.topLeftCorner<kMotor, kMotor>();
  for (int i = 0; i < kMotor; ++i)
    if (!regression_.included(i))
      errors(i, i) += regression_.inclusionProbability()(i) *
                      (widest_covariance_(i, i) + widest_mean_(i) * widest_mean_(i));
  Matrix3d covariance = g * errors * g.transpose();
  covariance.diagonal() += options_.cable_error.cwiseAbs2();
  return share_.value() * covariance;
}

Vector3d TransmissionEstimator::residual(const Observation& seen) const {
  Regression::Vector beside = regression_.mean() - used_;
  if (!estimate_.camerasMoved()) beside.tail<kCamera>().setZero();
  const Vector3d error = reading(seen).h * beside;
  const Matrix3d jacobian = arm_.tipJacobian(seen.q);
  const Vector3d joints = jacobian.partialPivLu().solve(error);
  return joints.allFinite() ? joints : Vector3d::Zero();
}

Vector3d TransmissionEstimator::stretchError(const Vector3d& q_kin, const Vector3d& q) const {
  const Vector3d stretch = correctedTravel(travelOf(q_kin)) - Vector3d(transmission_.linkTravel(q));
  return joints_from_travel_ * stretch.cwiseProduct(estimate_.compliance);
}

}  // namespace capstan::tracking
