#pragma once

#include <array>

#include "core/robot/kinematics.h"

namespace capstan::robot {

/// Rigid-body dynamics of any chain of one to seven joints, M(q) ddq + C(q, dq) dq + G(q) = tau, without
/// friction. The torque is computed by recursive Newton–Euler, the mass matrix by the composite-rigid-body
/// algorithm (Featherstone, Rigid Body Dynamics Algorithms, 2008, tables 5.1 and 6.2), both in link frames.
/// No allocation after construction.
class ChainDynamics {
 public:
  explicit ChainDynamics(const Description& description);

  int size() const { return chain_.size(); }
  /// Inverse dynamics tau = M ddq + C dq + G [N·m or N].
  JointVector inverse(const JointVector& q, const JointVector& dq, const JointVector& ddq) const;
  /// Bias C dq + G [N·m or N].
  JointVector bias(const JointVector& q, const JointVector& dq) const;
  /// Mass matrix M, symmetric positive definite.
  JointMatrix massMatrix(const JointVector& q) const;
  /// Forward dynamics ddq = M⁻¹ (tau − C dq − G), by Cholesky. tau is the sum of all joint torques: cables,
  /// friction, loads.
  JointVector forward(const JointVector& q, const JointVector& dq, const JointVector& tau) const;
  /// Kinetic energy ½ dqᵀ M dq, summed over the bodies [J].
  double kineticEnergy(const JointVector& q, const JointVector& dq) const;
  /// Potential energy −Σ m g · centre of mass, relative to the origin of frame 0 [J].
  double potentialEnergy(const JointVector& q) const;

 private:
  Chain chain_;
  Eigen::Vector3d gravity_;
  std::array<Link, kMaxJoints> links_;
};

}  // namespace capstan::robot
