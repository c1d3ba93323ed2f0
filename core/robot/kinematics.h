#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// Jacobian 6×n in frame 0: three angular rows (x, y, z), then three linear rows.
using JointJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxJoints>;

/// Transform link_{i-1} from link_i of a joint at q: RotX(alpha) TransX(a) RotZ(theta) TransZ(d).
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

/// Forward kinematics of the one to seven driven joints of any robot file. No allocation after construction.
class Chain {
 public:
  explicit Chain(const Description& description);

  int size() const { return size_; }
  const JointTransform& joint(int i) const { return joints_[static_cast<std::size_t>(i)]; }
  /// Transform frame 0 from the frame of `link`, which is 0 (the base) … size().
  Eigen::Isometry3d linkPose(int link, const JointVector& q) const;
  /// Marker centre in frame 0 [m].
  Eigen::Vector3d marker(const JointVector& q) const;
  /// Jacobian J: J dq is the angular velocity of the last link and the velocity of the marker [rad/s; m/s].
  JointJacobian markerJacobian(const JointVector& q) const;

 private:
  int size_;
  std::array<JointTransform, kMaxJoints> joints_;
  Eigen::Vector3d marker_;
};

}  // namespace capstan::robot
