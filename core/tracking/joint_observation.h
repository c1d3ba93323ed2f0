#pragma once

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/robot/arm_kinematics.h"

namespace capstan::tracking {

/// q_cam: joint positions from a camera observation [rad, rad, m].
struct JointObservation {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;
};

/// Joint positions for a tip in frame 0 [m] with covariance [m²], on the branch of the inverse kinematics
/// nearest to `near`:
///     q = IK(p),  Sigma_q = J⁻¹ Sigma_p J⁻ᵀ,  J the tip Jacobian at q.
/// Fails where the inverse kinematics fails, and with kSingular where Sigma_q is not finite.
inline base::Result<JointObservation, robot::ReachFault> observeJoints(const robot::ArmKinematics& arm,
                                                                       const Eigen::Vector3d& tip,
                                                                       const Eigen::Matrix3d& tip_covariance,
                                                                       const Eigen::Vector3d& near) {
  const auto solved = arm.solvePosition(tip, near);
  if (!solved) return base::failure(solved.error());
  const Eigen::Matrix3d inverse = arm.tipJacobian(*solved).inverse();
  const JointObservation seen{*solved, inverse * tip_covariance * inverse.transpose()};
  if (!seen.covariance.allFinite()) return base::failure(robot::ReachFault::kSingular);
  return seen;
}

}  // namespace capstan::tracking
