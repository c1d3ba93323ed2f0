#pragma once

#include <Eigen/Core>

#include "core/estimation/models.h"
#include "core/estimation/square_root_ukf.h"
#include "core/robot/transmission.h"
#include "core/tracking/cable_arm_model.h"

namespace capstan::tracking {

/// Measurement model, UKF paper (10): the camera and q_kin measure the positions among q1 dq1 q2 dq2 q3 dq3.
using JointMeasurement = estimation::LinearMeasurement<6, 3>;
JointMeasurement positionsOnly();

/// Resets the estimate of the joints in `set`: the mean position stays and gets the standard deviation
/// `position_sigma`; the mean speed becomes 0 and gets the standard deviation `speed`; the correlations with
/// other states become 0. `root` is a square root of the covariance of q1 dq1 q2 dq2 q3 dq3.
void forgetJoints(JointSet set, const Eigen::Vector3d& position_sigma, const Eigen::Vector3d& speed,
                  CableArmModel::State& mean, estimation::Lower<6>& root);

/// Observation that replaces the camera: y = H x + noise; the covariance of the noise is R = `root` ·
/// `root`ᵀ.
struct KinematicObservation {
  JointMeasurement measurement;
  Eigen::Vector3d y;
  estimation::Lower<3> root;
};

/// Transmission kinematics when the position of some motors is unknown. Motor i determines only its own
/// cable,
///     (A (q − q_hs))_i = r_mc,i q_m,i / (N r_l,i),
/// so without motor 1, q1 is unknown, and cables 2 and 3 determine q2 and q3 only for a given q1.
class PartialKinematics {
 public:
  explicit PartialKinematics(const robot::Transmission& transmission);

  /// Joints [rad, rad, m] that agree with q_kin in the cables of known motors and with `reference` in the
  /// others. q_kin is A⁻¹ applied to the motors, with any value for unknown motors.
  Eigen::Vector3d given(const Eigen::Vector3d& q_kin, JointSet unknown,
                        const Eigen::Vector3d& reference) const;

  /// Observation of the known cables of `q_kin`, whose joints have the standard deviations `sigma`. With all
  /// motors known it is q = q_kin. Otherwise it is A q for the known cables, with the covariance that
  /// follows, and the rows of H for unknown cables are 0.
  KinematicObservation observe(const Eigen::Vector3d& q_kin, JointSet unknown,
                               const Eigen::Vector3d& sigma) const;

 private:
  Eigen::Matrix3d coupling_, coupling_inverse_;
};

}  // namespace capstan::tracking
