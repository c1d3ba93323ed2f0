#include "core/experiments/motion_collector.h"

#include <cmath>

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

}  // namespace capstan::experiments
