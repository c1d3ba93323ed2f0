#include "core/live/armed_drive.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace capstan::live {

ArmedDrive::ArmedDrive(const robot::Description& robot, const std::array<double, 3>& speed)
    : target_(robot::homingOf(robot)) {
  CAPSTAN_CHECK(robot.size() >= 3);
  for (int k = 0; k < 3; ++k) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(k)];
    low_[k] = std::min(joint.limit_low, target_[k]);
    high_[k] = std::max(joint.limit_high, target_[k]);
    speed_[k] = std::min(speed[static_cast<std::size_t>(k)], joint.max_speed);
  }
}

bool ArmedDrive::isInside() const {
  const Eigen::Array3d margin = kMargin * (high_ - low_).array();
  return measured_.allFinite() && (measured_.array() >= low_.array() - margin).all() &&
         (measured_.array() <= high_.array() + margin).all();
}

void ArmedDrive::observe(double now, const Eigen::Vector3d& q) {
  measured_ = q;
  observed_ = true, observed_at_ = now;
  if (!isInside()) stop(DriveStop::kOutside);
}

bool ArmedDrive::arm(double now) {
  if (state_ == DriveState::kArmed || state_ == DriveState::kMoving) return true;
  cause_ = !isFresh(now) ? DriveStop::kSilent : !isInside() ? DriveStop::kOutside : DriveStop::kNone;
  if (cause_ != DriveStop::kNone) return false;
  state_ = DriveState::kArmed;
  return true;
}

void ArmedDrive::disarm() {
  state_ = DriveState::kDisarmed;
  cause_ = DriveStop::kNone;
}

void ArmedDrive::hold(double now) {
  if (state_ == DriveState::kArmed && isFresh(now)) begin(now);
  if (state_ == DriveState::kMoving) held_at_ = now;
}

void ArmedDrive::begin(double now) {
  state_ = DriveState::kMoving;
  point_ = measured_;
  moving_since_ = stepped_at_ = advanced_at_ = now;
  at_target_since_.reset();
}

void ArmedDrive::release() {
  if (state_ == DriveState::kMoving) state_ = DriveState::kArmed;
}

void ArmedDrive::stop(DriveStop cause) {
  if (state_ != DriveState::kArmed && state_ != DriveState::kMoving) return;
  state_ = DriveState::kStopped;
  cause_ = cause;
}

/// Moves the set-point for `passed` [s] along its line, unless it would lead the arm by too much.
void ArmedDrive::advance(double passed, double now) {
  const Eigen::Vector3d rest = target_ - point_;
  const double time_left = rest.cwiseQuotient(speed_).lpNorm<Eigen::Infinity>();  // at full speed
  constexpr double kSlowest = 0.1;                                                // share of full speed
  const double ramp = std::min((now - moving_since_) / kRamp, time_left / kRamp);
  const double covered = std::clamp(ramp, kSlowest, 1.0) * passed;
  const Eigen::Vector3d next =
      covered >= time_left ? target_ : Eigen::Vector3d(point_ + covered / time_left * rest);
  const Eigen::Array3d lead = (next - measured_).array().abs();
  const bool leads = (lead > kLead * speed_.array() && lead > (point_ - measured_).array().abs()).any();
  if (leads) return;
  point_ = next;
  advanced_at_ = now;
}

std::optional<Eigen::Vector3d> ArmedDrive::step(double now) {
  const bool live = state_ == DriveState::kArmed || state_ == DriveState::kMoving;
  if (live && !isFresh(now)) stop(DriveStop::kSilent);
  if (state_ == DriveState::kMoving && now - held_at_ > kHold) release();
  if (state_ != DriveState::kMoving) return {};
  const double passed = std::clamp(now - stepped_at_, 0.0, kLongestStep);
  stepped_at_ = now;
  if (point_ != target_) {
    advance(passed, now);
    if (now - advanced_at_ > kStuck) stop(DriveStop::kStuck);
  } else {
    if (!at_target_since_) at_target_since_ = now;
    if (now - *at_target_since_ > kSettle) stop(DriveStop::kArrived);
  }
  if (state_ != DriveState::kMoving) return {};
  return point_;
}

std::string ArmedDrive::reason() const {
  return cause_ == DriveStop::kNone ? std::string() : std::string(base::nameOf(cause_));
}

}  // namespace capstan::live
