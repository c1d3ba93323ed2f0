#include "core/tracking/camera_noise.h"

#include <algorithm>
#include <cmath>

#include "core/robot/arm_kinematics.h"

namespace capstan::tracking {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void PixelNoise::add(double chi_square) {
  if (memory_ <= 0 || !std::isfinite(chi_square)) return;
  seen_ = std::min(seen_ + 1, std::max(memory_ - kPrior, 1));
  ratio_ += (std::min(chi_square, kOutlier * ratio_) - ratio_) / static_cast<double>(kPrior + seen_);
}

CameraNoise::CameraNoise(const robot::Description& robot, const TrackingOptions& options)
    : options_(options),
      hard_stop_(robot::ArmKinematics(robot).tip(robot::homingOf(robot))),
      pixels_(options.pixel_noise_memory) {}

Matrix3d CameraNoise::ofRegistration(const Vector3d& tip) const {
  const Vector3d d = tip - hard_stop_;
  const double rotation = options_.registration_rotation_sigma, shift = options_.registration_shift_sigma;
  return (shift * shift + rotation * rotation * d.squaredNorm()) * Matrix3d::Identity() -
         rotation * rotation * d * d.transpose();
}

Matrix3d CameraNoise::ofImagedTip(const Vector3d& tip, const Matrix3d& pixels) const {
  return pixels_.ratio() * pixels + ofRegistration(tip);
}

Matrix3d CameraNoise::ofTip(const Vector3d& tip) const {
  return options_.tip_sigma.cwiseAbs2().asDiagonal().toDenseMatrix() + ofRegistration(tip);
}

Matrix3d CameraNoise::ofJoints(const JointObservation& seen, const Vector3d& speed, double clock) const {
  if (options_.camera_noise == CameraNoiseKind::kConstant)
    return options_.constant_camera_sigma.cwiseAbs2().asDiagonal();
  const Vector3d late = clock * speed;
  Matrix3d r = seen.covariance + late * late.transpose();
  r.diagonal() += options_.camera_sigma_floor.cwiseAbs2();
  return r;
}

}  // namespace capstan::tracking
