#include "core/learning/poses/rotation_vector.h"

#include <cmath>

namespace capstan::learning {

Eigen::Vector3d rotationVector(const Eigen::Quaterniond& turn) {
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0, sine = turn.vec().norm();
  if (sine < 1e-9) return 2.0 * sign * turn.vec();
  return 2.0 * std::atan2(sine, std::abs(turn.w())) / sine * sign * turn.vec();
}

Eigen::Quaterniond turnBy(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle < 1e-9) {
    Eigen::Quaterniond turn(1.0, 0.0, 0.0, 0.0);
    turn.vec() = 0.5 * rotation_vector;
    return turn.normalized();
  }
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

}  // namespace capstan::learning
