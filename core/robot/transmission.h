#pragma once

#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// Transmission from motors to joints through gears, capstans and coupled cables, for one to seven joints.
/// q_m [rad] is zero at the hard stop q_hs.
///   s_m = r_mc ∘ q_m / N                 motor side cable travel [m]
///   s_l = r_l ∘ (A (q − q_hs))           link side cable travel [m]
///   delta = s_m − s_l                    cable stretch [m]; 0 in transmission kinematics
class Transmission {
 public:
  explicit Transmission(const Description& description);

  int size() const { return static_cast<int>(homing_.size()); }
  const JointVector& homing() const { return homing_; }      ///< q_hs [rad or m]
  const JointMatrix& coupling() const { return coupling_; }  ///< A
  /// r_mc / N: cable travel per motor angle [m/rad], and motor torque per cable force [N·m/N].
  const JointVector& motorRadius() const { return motor_radius_; }
  const JointVector& linkRadius() const { return link_radius_; }  ///< r_l [m/rad or m/m]

  JointVector motorTravel(const JointVector& q_m) const { return motor_radius_.cwiseProduct(q_m); }
  JointVector linkTravel(const JointVector& q) const;
  JointVector linkTravelRate(const JointVector& dq) const;

  /// Transmission kinematics q_kin = q_hs + A⁻¹ (r_mc q_m / (N r_l)), its rate, and their inverses.
  JointVector jointFromMotor(const JointVector& q_m) const;
  JointVector jointVelocityFromMotor(const JointVector& dq_m) const;
  JointVector motorFromJoint(const JointVector& q) const;
  JointVector motorVelocityFromJoint(const JointVector& dq) const;

  /// Joint torques Gamma = Aᵀ (r_l ∘ gamma) [N·m or N] of the cable forces gamma [N].
  JointVector jointTorque(const JointVector& cable_force) const;
  /// Motor reaction torques tau_rn = r_mc ∘ gamma / N [N·m].
  JointVector motorReaction(const JointVector& cable_force) const {
    return motor_radius_.cwiseProduct(cable_force);
  }

 private:
  JointVector homing_, motor_radius_, link_radius_;
  JointMatrix coupling_, coupling_inverse_;
};

}  // namespace capstan::robot
