#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// 6×n: rows angular (x, y, z) then linear, in frame 0.
using JointJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints>;

/// One joint's transform link_{i-1} from link_i, RotX(alpha) TransX(a) RotZ(theta) TransZ(d), as a function
/// of q.
class JointTransform {
 public:
  JointTransform() = default;
  JointTransform(const DhRow& dh, JointType type);
  explicit JointTransform(const Joint& joint) : JointTransform(joint.dh, joint.type) {}

  Eigen::Isometry3d at(double q) const;
  bool revolute() const { return type_ == JointType::kRevolute; }

 private:
  DhRow dh_;
  JointType type_ = JointType::kRevolute;
  double sin_alpha_ = 0.0, cos_alpha_ = 1.0;
};

/// Forward kinematics of the driven joints, one to seven, of any robot file. Never allocates once built.
class Chain {
 public:
  explicit Chain(const Description& description);

  int size() const { return size_; }
  const JointTransform& joint(int i) const { return joints_[static_cast<std::size_t>(i)]; }
  /// Frame 0 from the frame of `link`, 0 (the base itself) … size().
  Eigen::Isometry3d linkPose(int link, const JointVector& q) const;
  /// Marker centre in frame 0 [m].
  Eigen::Vector3d marker(const JointVector& q) const;
  /// Velocity of the last link and of the point that now coincides with the marker centre: J dq [rad/s; m/s].
  JointJacobian markerJacobian(const JointVector& q) const;

 private:
  int size_;
  std::array<JointTransform, kMaxJoints> joints_;
  Eigen::Vector3d marker_;
};

}  // namespace capstan::robot
