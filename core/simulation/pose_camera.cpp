#include "core/simulation/pose_camera.h"

#include <cmath>

namespace capstan::simulation {
namespace {

Eigen::Isometry3d poseOf(const Eigen::Vector3d& shift, const Eigen::Vector3d& rotation_vector) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0.0) pose.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  pose.translation() = shift;
  return pose;
}

}  // namespace

PoseCamera::PoseCamera(const PoseCameraTruth& truth, std::uint64_t seed)
    : truth_(truth),
      random_(seed, "pose camera"),
      registration_(poseOf(truth.registration_shift, truth.registration_rotation)),
      mounting_(poseOf(Eigen::Vector3d::Zero(), truth.mounting_rotation)),
      jump_(Eigen::Isometry3d::Identity()) {}

Eigen::Vector3d PoseCamera::drawn(double sigma) {
  Eigen::Vector3d vector;
  for (double& x : vector) x = random_.normal(0.0, sigma);
  return vector;
}

PoseObservation PoseCamera::see(double t, const Eigen::Isometry3d& pose) {
  PoseObservation observation;
  const double period = 1.0 / truth_.rate;
  observation.t = t + truth_.latency + random_.normal(0.0, truth_.clock_jitter);
  const Eigen::Isometry3d noise = poseOf(drawn(truth_.position_sigma), drawn(truth_.rotation_sigma));
  if (jump_left_ <= 0.0 && random_.uniform(0.0, 1.0) < truth_.jump_rate * period) {
    jump_left_ = -truth_.jump_time * std::log(random_.uniform(1e-12, 1.0));
    jump_ = poseOf(drawn(truth_.jump_size), drawn(truth_.jump_rotation));
  }
  if (random_.uniform(0.0, 1.0) < truth_.miss_share) return observation;
  observation.observed = true;
  observation.pose = registration_ * pose * mounting_ * noise;
  if (jump_left_ > 0.0) observation.pose = observation.pose * jump_;
  jump_left_ -= period;
  return observation;
}

}  // namespace capstan::simulation
