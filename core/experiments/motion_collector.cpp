#include "core/experiments/motion_collector.h"

#include <algorithm>
#include <cmath>

#include "core/base/room.h"

namespace capstan::experiments {

double roundedTime(double t) { return std::round(t * 1e6) / 1e6; }

Eigen::Vector3d rounded(const Eigen::Vector3d& joints) {
  return joints.unaryExpr([](double value) { return std::round(value * 1e9) / 1e9; });
}

MotionCollector::MotionCollector(const TrialSource& source, TrialMotion& motion)
    : source_(source),
      motion_(motion),
      nominal_(source.nominal()),
      reference_(source.info().reference || source.info().own_kinematics) {}

void MotionCollector::take(const tracking::Snapshot& s) {
  if (s.motor_updated) {
    if (samples_++ == 0) motion_.begin = s.t;
    if (source_.blocked()) ++blocked_;
  }
  if (samples_ > 0) motion_.end = s.t;
  if (s.camera_updated && s.gate == tracking::Gate::kOpen) takeCamera(s);
  if (reference_ ? s.reference_paired : s.motor_updated) takePoint(s);
}

void MotionCollector::finish() {
  if (samples_ > 0) motion_.occluded_share = static_cast<double>(blocked_) / static_cast<double>(samples_);
}

void MotionCollector::takeCamera(const tracking::Snapshot& s) {
  seen_ = s.q_link_cam;
  motion_.camera.push_back(
      {roundedTime(s.t_cam), rounded(s.q_link_cam), rounded(s.q_link_cam - s.q_link_true_cam)});
}

void MotionCollector::takePoint(const tracking::Snapshot& s) {
  if (!due_.due(s.t)) return;
  TrajectoryPoint point;
  point.t = roundedTime(s.t);
  if (reference_) point.q_true = rounded(s.q_link_true);
  point.q_kin = rounded(kinematicOf(s));
  point.q_cam = rounded(seen_);
  point.q_ukf = rounded(s.q_link_ukf);
  point.sigma = rounded(s.q_link_ukf_sigma);
  point.occluded = source_.blocked();
  motion_.trajectory.push_back(point);
  seen_ = noJoints();
}

SessionMotion::SessionMotion(std::size_t capacity, bool reference)
    : capacity_(capacity),
      reference_(reference),
      points_(base::roomFor<TrajectoryPoint>(std::min(capacity, kCapacity))) {}

void SessionMotion::take(const tracking::Snapshot& s) {
  const std::lock_guard lock(mutex_);
  if (s.camera_updated && s.gate == tracking::Gate::kOpen) seen_ = s.q_link_cam;
  if (!(reference_ ? s.reference_paired : s.motor_updated) || !due_.due(s.t)) return;
  if (points_.size() == capacity_) {
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
    points_.resize((points_.size() + 1) / 2);
    rate_ *= 0.5;
    due_ = base::DueTimes(rate_);
    (void)due_.due(points_.back().t);
    if (!due_.due(s.t)) return;
  }
  points_.push_back({s.t, reference_ ? s.q_link_true : noJoints(), s.q_link_kin, seen_, s.q_link_ukf,
                     s.q_link_ukf_sigma, tracking::markerLost(s) || tracking::cameraSilent(s)});
  seen_ = noJoints();
}

void SessionMotion::restart() {
  const std::lock_guard lock(mutex_);
  points_.clear();
  rate_ = kRate;
  due_ = base::DueTimes(rate_);
  seen_ = noJoints();
}

std::vector<TrajectoryPoint> SessionMotion::trajectory() const {
  const std::lock_guard lock(mutex_);
  return points_;
}

}  // namespace capstan::experiments
