#include "core/robot/kinematics.h"

#include <cmath>

#include "core/base/check.h"

namespace capstan::robot {

JointTransform::JointTransform(const DhRow& dh, JointType type)
    : dh_(dh), type_(type), sin_alpha_(std::sin(dh.alpha)), cos_alpha_(std::cos(dh.alpha)) {}

Eigen::Isometry3d JointTransform::at(double q) const {
  const double theta = revolute() ? dh_.theta + q : dh_.theta;
  const double d = revolute() ? dh_.d : dh_.d + q;
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  Eigen::Isometry3d pose;
  pose.matrix() << c, -s, 0.0, dh_.a,                                //
      cos_alpha_ * s, cos_alpha_ * c, -sin_alpha_, -sin_alpha_ * d,  //
      sin_alpha_ * s, sin_alpha_ * c, cos_alpha_, cos_alpha_ * d,    //
      0.0, 0.0, 0.0, 1.0;
  return pose;
}

Chain::Chain(const Description& description) : size_(description.size()), marker_(description.marker) {
  CAPSTAN_CHECK(size_ >= 1 && size_ <= kMaxJoints);
  for (int i = 0; i < size_; ++i)
    joints_[static_cast<std::size_t>(i)] = JointTransform(description.joints[static_cast<std::size_t>(i)]);
}

Eigen::Isometry3d Chain::linkPose(int link, const JointVector& q) const {
  CAPSTAN_ASSERT(link >= 0 && link <= size_ && q.size() == size_);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < link; ++i) pose = pose * joint(i).at(q[i]);
  return pose;
}

Eigen::Vector3d Chain::marker(const JointVector& q) const { return linkPose(size_, q) * marker_; }

JointJacobian Chain::markerJacobian(const JointVector& q) const {
  const Eigen::Vector3d point = marker(q);
  JointJacobian jacobian(6, size_);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < size_; ++i) {
    pose = pose * joint(i).at(q[i]);
    const Eigen::Vector3d axis = pose.linear().col(2);
    if (joint(i).revolute())
      jacobian.col(i) << axis, axis.cross(point - pose.translation());
    else
      jacobian.col(i) << Eigen::Vector3d::Zero(), axis;
  }
  return jacobian;
}

}  // namespace capstan::robot
