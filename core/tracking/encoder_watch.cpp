#include "core/tracking/encoder_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/robot/transmission.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSigmas = 3.0;  // bound on noise, in σ; chance rarely exceeds it several times in succession

Vector3d motorsAtRangeMiddle(const robot::Description& robot) {
  Vector3d middle;
  for (int i = 0; i < 3; ++i) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    middle(i) = 0.5 * (joint.limit_low + joint.limit_high);
  }
  return robot::Transmission(robot).motorFromJoint(middle);
}

}  // namespace

double stillWithin(const robot::Drive& drive) {
  constexpr double kCounts = 1.25;
  return kCounts * 2.0 * std::numbers::pi / drive.encoder_counts;
}

EncoderWatch::EncoderWatch(const robot::Description& robot, const TrackingOptions& options)
    : coupling_(robot::Transmission(robot).coupling()),
      held_(motorsAtRangeMiddle(robot)),
      still_within_(stillWithin(robot.drives[0]), stillWithin(robot.drives[1]), stillWithin(robot.drives[2])),
      tolerance_(options.frozen_tolerance),
      believable_(options.jump_tolerance),
      speed_(options.unknown_speed),
      detect_(options.detect_frozen),
      lost_after_(options.lost_after),
      restart_gap_(options.restart_gap),
      longest_gap_(3.5 * options.camera_period),
      known_for_(0.5 * options.camera_period),
      samples_(options.jump_samples) {}

void EncoderWatch::restart() {
  still_ = {};
  seen_ = {};
  newest_.reset();
}

void EncoderWatch::clear() {
  restart();
  gap_ = 0;
  for (int motor = 0; motor < 3; ++motor)
    if (MotorFault& fault = faults_[static_cast<std::size_t>(motor)]; fault != MotorFault::kDeclared) {
      fault = MotorFault::kNone;
      failed_ &= ~(1U << motor);
    }
}

void EncoderWatch::fail(int motor, MotorFault fault) {
  faults_[static_cast<std::size_t>(motor)] = fault;
  failed_ |= 1U << motor;
}

void EncoderWatch::declare(int motor, bool failed) {
  still_[static_cast<std::size_t>(motor)] = {};
  if (failed) return fail(motor, MotorFault::kDeclared);
  faults_[static_cast<std::size_t>(motor)] = MotorFault::kNone;
  failed_ &= ~(1U << motor);
}

void EncoderWatch::watchStill(int motor, double t, double position) {
  Still& still = still_[static_cast<std::size_t>(motor)];
  if (still.valid && std::abs(position - still.position) <= still_within_(motor)) return;
  still = {};
  still.valid = true;
  still.position = position;
  still.since = t;
}

std::optional<MotorSample> EncoderWatch::take(const MotorSample& sample) {
  if (!std::isfinite(sample.t)) return std::nullopt;
  const bool any = sample.position.array().isFinite().any();
  if (!any && !(newest_ && sample.t > *newest_ && sample.t - *newest_ < restart_gap_)) return std::nullopt;
  if (newest_ && sample.t - *newest_ > known_for_) still_ = {}, seen_ = {};
  MotorSample clean = sample;
  for (int motor = 0; motor < 3; ++motor) {
    const JointSet bit = 1U << motor;
    if (std::isfinite(sample.position(motor))) {
      held_(motor) = sample.position(motor);
      gap_ &= ~bit;
      watchStill(motor, sample.t, held_(motor));
      continue;
    }
    double& since = gap_since_[static_cast<std::size_t>(motor)];
    if (!contains(gap_, motor)) since = sample.t;
    gap_ |= bit;
    if (!contains(failed_, motor) && sample.t - since >= lost_after_) fail(motor, MotorFault::kLost);
    still_[static_cast<std::size_t>(motor)] = {};
    clean.position(motor) = held_(motor);
    clean.velocity(motor) = 0.0;
  }
  newest_ = std::max(newest_.value_or(sample.t), sample.t);
  return clean;
}

/// True if the marker moved on a continuous path since the last camera sample, within noise and the usual
/// speed.
bool EncoderWatch::isContinuous(const Seen& now) const {
  const double since = now.t - seen_.t;
  if (!seen_.valid || !(since > 0.0) || since > longest_gap_) return false;
  const Vector3d reach = kSigmas * ((now.variance + seen_.variance).cwiseSqrt() + since * speed_);
  return ((now.q - seen_.q).cwiseAbs().array() <= reach.array()).all();
}

JointSet EncoderWatch::see(double t, const Vector3d& q_cam, const Matrix3d& covariance,
                           const Vector3d& q_kin) {
  if (!detect_) return 0;
  const Seen now{true, t, q_cam, covariance.diagonal()};
  const bool continuous = isContinuous(now);
  seen_ = now;
  if (!newest_ || t > *newest_ + known_for_) return 0;
  const Vector3d link = coupling_ * q_cam, disagreement = coupling_ * (q_cam - q_kin);
  const Vector3d variance = (coupling_ * covariance * coupling_.transpose()).diagonal();
  JointSet candidates = 0, dissent = 0;
  for (int motor = 0; motor < 3; ++motor) {
    Still& still = still_[static_cast<std::size_t>(motor)];
    if (contains(unknown(), motor) || !still.valid || t < still.since) continue;
    if (!still.seen || !continuous) {
      still.seen = true;
      still.run = 0;
      still.link = link(motor);
      still.variance = variance(motor);
    }
    const double bound = tolerance_(motor) + kSigmas * std::sqrt(variance(motor) + still.variance);
    if (std::abs(link(motor) - still.link) > bound) candidates |= 1U << motor;
  }
  for (int motor = 0; motor < 3; ++motor)
    if (!contains(candidates | unknown(), motor) && !(std::abs(disagreement(motor)) <= believable_(motor)))
      dissent |= 1U << motor;
  JointSet frozen = 0;
  for (int motor = 0; motor < 3; ++motor) {
    int& run = still_[static_cast<std::size_t>(motor)].run;
    run = contains(candidates, motor) && dissent == 0 ? run + 1 : 0;
    if (run < samples_) continue;
    fail(motor, MotorFault::kFrozen);
    frozen |= 1U << motor;
  }
  return frozen;
}

}  // namespace capstan::tracking
