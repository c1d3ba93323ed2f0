#pragma once

#include <Eigen/Geometry>

#include "core/robot/chain_dynamics.h"
#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"
#include "core/simulation/tool_truth.h"

namespace capstan::simulation {

/// Quasi-static dynamics of a cable-driven arm with tool roll, wrist and two jaws. Motors under PD control
/// drive the joints through cables that stretch, are coupled, and have backlash. Inertia is neglected; these
/// equations hold at each instant (quasi_static.h):
///   K_p (q_md − q_m) + K_d (dq_md − dq_m) − tau_vm dq_m − r_mc gamma / N ∈ tau_cm sgn dq_m
///   s_m = r_mc q_m / N + e (sin(q_m / N + φ) − sin φ),   delta = s_m − r_l ∘ (A (q − q_hs))
///   gamma = k (delta beyond play),   Gamma = Aᵀ (r_l ∘ gamma)
///   Gamma − G(q) − F_v dq ∈ (F_c (1 + excess e^{−(dq/v_s)²}) + mu |Gamma|) sgn dq
/// So the position of a joint depends on the direction and the speed of its motion. The integration is
/// implicit Euler. Each step solves joint after joint until none moves; the solution is unique, as forces and
/// friction derive from a convex energy. r_l, A, q_hs and the geometry are those of the truth.
class ToolArm {
 public:
  /// Throws base::InputError unless the robot has seven joints.
  ToolArm(const robot::Description& nominal, const ToolTruth& truth);

  /// Sets motor angles `q_motor` [rad] with unstretched cables; the joints follow from the true transmission.
  void reset(const robot::JointVector& q_motor);
  /// Advances by `dt` [s] towards motor angles [rad] that change at `target_rate` [rad/s].
  void step(const robot::JointVector& target, const robot::JointVector& target_rate, double dt);

  const robot::JointVector& motors() const { return q_motor_; }  ///< motor angles from the hard stop [rad]
  robot::JointVector encoders() const;                           ///< motor angles in whole counts [rad]
  const robot::JointVector& joints() const { return q_; }        ///< true joints [rad or m]
  robot::JointVector cableForce() const;                         ///< cable forces gamma [N]
  /// Pose in frame 0 of the frame between the jaws.
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
  robot::JointVector stiffness_;    ///< stiffness of each joint by itself with all cables tight
  robot::JointVector q_motor_, q_;  ///< present motor angles [rad] and joints [rad or m]
  robot::JointVector begin_;        ///< joints at the beginning of the step
  robot::JointVector speed_;        ///< joint velocities of the previous step [rad/s or m/s]
  robot::JointVector delta_;        ///< stretches [m]
  robot::JointVector gravity_;      ///< G [N·m or N]
};

}  // namespace capstan::simulation
