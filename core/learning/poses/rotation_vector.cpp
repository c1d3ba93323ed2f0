#include "core/learning/poses/rotation_vector.h"

#include <cmath>

namespace capstan::learning {

Eigen::Vector3d rotationVector(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0, sine = rotation.vec().norm();
  if (sine < 1e-9) return 2.0 * sign * rotation.vec();
  return 2.0 * std::atan2(sine, std::abs(rotation.w())) / sine * sign * rotation.vec();
}

Eigen::Quaterniond turnBy(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle < 1e-9) {
    Eigen::Quaterniond rotation(1.0, 0.0, 0.0, 0.0);
    rotation.vec() = 0.5 * rotation_vector;
    return rotation.normalized();
  }
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

}  // namespace capstan::learning
