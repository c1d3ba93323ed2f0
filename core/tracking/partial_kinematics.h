#pragma once

#include <Eigen/Core>

#include "core/estimation/models.h"
#include "core/estimation/square_root_ukf.h"
#include "core/robot/transmission.h"
#include "core/tracking/cable_arm_model.h"

namespace capstan::tracking {

/// UKF paper (10): of states q1 dq1 q2 dq2 q3 dq3, the camera and q_kin see positions.
using JointMeasurement = estimation::LinearMeasurement<6, 3>;
JointMeasurement positionsOnly();

/// Makes the joints in `set` as good as unknown: the mean of their position stays, with the standard
/// deviation `position_sigma`, they are at rest with that of `speed`, and no other measurement of them
/// exists. `root` is a square root of the covariance of q1 dq1 q2 dq2 q3 dq3.
void forgetJoints(JointSet set, const Eigen::Vector3d& position_sigma, const Eigen::Vector3d& speed,
                  CableArmModel::State& mean, estimation::Lower<6>& root);

/// Observation that replaces the camera: y = H x + noise of covariance root rootᵀ.
struct KinematicObservation {
  JointMeasurement measurement;
  Eigen::Vector3d y;
  estimation::Lower<3> root;
};

/// Transmission kinematics where the position of some motors is unknown. Motor i knows only its cable,
///     (A (q − q_hs))_i = r_mc,i q_m,i / (N r_l,i),
/// so without motor 1 nothing is known of q1, and of q2 and q3 only what cables 2 and 3 say given q1.
class PartialKinematics {
 public:
  explicit PartialKinematics(const robot::Transmission& transmission);

  /// Joints that agree with q_kin (q_m through A⁻¹, unknown motors held at anything) in the known cables and
  /// with `reference` in the unknown ones [rad, rad, m].
  Eigen::Vector3d given(const Eigen::Vector3d& q_kin, JointSet unknown,
                        const Eigen::Vector3d& reference) const;

  /// The known cables of `q_kin`, whose joints have the standard deviations `sigma`: with all motors known,
  /// q = q_kin; else A q for the known cables, with the covariance that follows, and rows of H = 0 for the
  /// unknown ones.
  KinematicObservation observe(const Eigen::Vector3d& q_kin, JointSet unknown,
                               const Eigen::Vector3d& sigma) const;

 private:
  Eigen::Matrix3d coupling_, coupling_inverse_;
};

}  // namespace capstan::tracking
