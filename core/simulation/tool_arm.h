#pragma once

#include <Eigen/Geometry>

#include "core/robot/chain_dynamics.h"
#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"
#include "core/simulation/tool_truth.h"

namespace capstan::simulation {

/// A cable-driven arm with tool roll, wrist and two jaws, moving slowly: motors under PD control pull joints
/// by cables that stretch, run over each other, and have play; inertia is neglected, all else holds at each
/// instant (quasi_static.h):
///   K_p (q_md − q_m) + K_d (dq_md − dq_m) − tau_vm dq_m − r_mc gamma / N ∈ tau_cm sgn dq_m
///   s_m = r_mc q_m / N + e (sin(q_m / N + φ) − sin φ),   delta = s_m − r_l ∘ (A (q − q_hs))
///   gamma = k (delta beyond play),   Gamma = Aᵀ (r_l ∘ gamma)
///   Gamma − G(q) − F_v dq ∈ (F_c (1 + excess e^{−(dq/v_s)²}) + mu |Gamma|) sgn dq
/// so that where a joint stands depends on where it came from and how fast. Implicit Euler; joints in turn
/// until all hold, which finds the one solution, since forces and friction are those of a convex energy.
/// r_l, A, q_hs and the geometry are the truth's.
class ToolArm {
 public:
  /// base::InputError: not seven joints.
  ToolArm(const robot::Description& nominal, const ToolTruth& truth);

  /// Motors there, cables unstretched, joints where that puts them.
  void reset(const robot::JointVector& q_motor);
  /// Advances by `dt` [s] towards motor angles [rad] that change at `target_rate` [rad/s].
  void step(const robot::JointVector& target, const robot::JointVector& target_rate, double dt);

  const robot::JointVector& motors() const { return q_motor_; }  ///< [rad], from the hard stop
  robot::JointVector encoders() const;                           ///< the same in whole counts
  const robot::JointVector& joints() const { return q_; }        ///< [rad or m]
  robot::JointVector cableForce() const;                         ///< gamma [N]
  /// Frame 0 from the frame between the jaws.
  Eigen::Isometry3d pose() const;

 private:
  struct MotorNumbers {
    double lever, inverse_gear, coulomb, viscous, count;
  };
  double motorTravel(int i, double angle) const;
  double cableForce(int i) const;
  const ToolJointTruth& truth(int i) const { return truth_.joints[static_cast<std::size_t>(i)]; }
  void moveMotors(const robot::JointVector& target, const robot::JointVector& target_rate, double dt);
  double moveJoint(int i, double dt);

  ToolTruth truth_;
  robot::Chain chain_;
  robot::ChainDynamics bodies_;
  robot::Transmission transmission_;
  std::array<MotorNumbers, robot::kToolJoints> motors_;
  robot::JointMatrix travel_;       ///< diag(r_l) A: cable travel by joint
  robot::JointVector stiffness_;    ///< of each joint by itself, all cables tight
  robot::JointVector q_motor_, q_;  ///< now
  robot::JointVector begin_;        ///< joints at the begin of the step
  robot::JointVector speed_;        ///< of the step before [rad/s or m/s]
  robot::JointVector delta_;        ///< stretches [m]
  robot::JointVector gravity_;      ///< G [N·m or N]
};

}  // namespace capstan::simulation
