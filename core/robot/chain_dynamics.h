#pragma once

#include <array>

#include "core/robot/kinematics.h"

namespace capstan::robot {

/// Rigid-body dynamics of any chain of one to seven joints, M(q) ddq + C(q, dq) dq + G(q) = tau, without
/// friction: recursive Newton–Euler for the torque, composite rigid bodies for the mass matrix (Featherstone,
/// Rigid Body Dynamics Algorithms, 2008, tables 5.1 and 6.2), written in link frames. Never allocates once
/// built.
class ChainDynamics {
 public:
  explicit ChainDynamics(const Description& description);

  int size() const { return chain_.size(); }
  /// tau = M ddq + C dq + G [N·m or N].
  JointVector inverse(const JointVector& q, const JointVector& dq, const JointVector& ddq) const;
  /// C dq + G.
  JointVector bias(const JointVector& q, const JointVector& dq) const;
  /// M, symmetric positive definite.
  JointMatrix massMatrix(const JointVector& q) const;
  /// ddq = M⁻¹ (tau − C dq − G), by Cholesky; tau is the sum of all joint torques, cables, friction and
  /// loads.
  JointVector forward(const JointVector& q, const JointVector& dq, const JointVector& tau) const;
  /// ½ dqᵀ M dq, summed body by body [J].
  double kineticEnergy(const JointVector& q, const JointVector& dq) const;
  /// −Σ m g · centre of mass, from frame 0 [J].
  double potentialEnergy(const JointVector& q) const;

 private:
  Chain chain_;
  Eigen::Vector3d gravity_;
  std::array<Link, kMaxJoints> links_;
};

}  // namespace capstan::robot
