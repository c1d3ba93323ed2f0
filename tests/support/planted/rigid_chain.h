#pragma once

#include <Eigen/Core>
#include <array>

#include "core/robot/description.h"

namespace capstan::test {

inline constexpr int kMostJoints = 7;
/// One number per joint.
using Joints = std::array<double, kMostJoints>;

/// Rigid-body dynamics of a chain of one to seven joints over a modified Denavit–Hartenberg table,
/// independent of core/robot: outward–inward Newton–Euler recursion (Luh, Walker, Paul 1980, in the form of
/// Craig, Introduction to Robotics, 3rd ed., 6.45–6.53), mass matrix column by column.
class RigidChain {
 public:
  explicit RigidChain(const robot::Description& robot);

  int size() const { return size_; }
  /// Computes rotations and origins of every frame at `q` [rad or m]; the functions below are for this pose.
  void pose(const Joints& q);
  /// Inverse dynamics tau = M ddq + C dq + G [N·m or N].
  Joints inverse(const Joints& dq, const Joints& ddq) const { return recursion(dq, ddq, gravity_); }
  /// Bias torque C dq + G [N·m or N].
  Joints bias(const Joints& dq) const { return recursion(dq, Joints{}, gravity_); }
  /// Mass matrix M(q), in the upper left size() × size() block.
  using Matrix = std::array<Joints, kMostJoints>;
  Matrix massMatrix() const;
  /// Position in frame 0 of a point of the last frame [m].
  Eigen::Vector3d point(const Eigen::Vector3d& in_last) const;
  /// Energy ½ dqᵀ M dq − Σ m g · centre of mass [J].
  double energy(const Joints& dq) const;

  void setGravity(const Eigen::Vector3d& gravity) { gravity_ = gravity; }
  const Eigen::Vector3d& gravity() const { return gravity_; }
  /// Adds a point mass [kg] at a point of link i (0-based), by the parallel-axis theorem.
  void addPointMass(int i, double mass, const Eigen::Vector3d& at);

 private:
  struct Body {
    robot::DhRow dh;
    bool turns = true;
    double cos_alpha = 1.0, sin_alpha = 0.0;
    double mass = 0.0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, link axes
  };

  Joints recursion(const Joints& dq, const Joints& ddq, const Eigen::Vector3d& gravity) const;

  int size_ = 0;
  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
  std::array<Body, kMostJoints> bodies_;
  std::array<Eigen::Matrix3d, kMostJoints> rotation_;  ///< rotation of link i in the frame before
  std::array<Eigen::Vector3d, kMostJoints> origin_;    ///< origin of link i in the frame before [m]
};

/// Solution x of A x = b for the symmetric positive definite upper left n × n block of A, by square-root-free
/// Cholesky factorisation.
Joints solveSymmetric(RigidChain::Matrix a, const Joints& b, int n);

}  // namespace capstan::test
