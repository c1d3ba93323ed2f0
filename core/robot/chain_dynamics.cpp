#include "core/robot/chain_dynamics.h"

#include <Eigen/Cholesky>

#include "core/base/check.h"

namespace capstan::robot {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Wrench on a body about the origin of its link frame.
struct BodyWrench {
  Vector3d moment = Vector3d::Zero();
  Vector3d force = Vector3d::Zero();
};

/// Motion of a link in the axes of its frame: angular velocity, angular acceleration, and linear acceleration
/// of the frame's origin.
struct Motion {
  Vector3d omega = Vector3d::Zero();
  Vector3d alpha = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();
};

Motion moved(const Motion& before, const Isometry3d& joint, bool revolute, double dq, double ddq) {
  const Matrix3d to_link = joint.linear().transpose();
  const Vector3d p = joint.translation();
  const Vector3d carried =
      before.acceleration + before.alpha.cross(p) + before.omega.cross(before.omega.cross(p));
  Motion motion;
  motion.omega = to_link * before.omega;
  motion.alpha = to_link * before.alpha;
  motion.acceleration = to_link * carried;
  const Vector3d axis = Vector3d::UnitZ();
  if (revolute) {
    motion.alpha += motion.omega.cross(axis * dq) + axis * ddq;
    motion.omega += axis * dq;
  } else {
    motion.acceleration += 2.0 * motion.omega.cross(axis * dq) + axis * ddq;
  }
  return motion;
}

/// Wrench that the motion of the body requires (Newton–Euler).
BodyWrench needed(const Link& link, const Motion& m) {
  const Vector3d& c = link.centre_of_mass;
  BodyWrench wrench;
  wrench.force = link.mass * (m.acceleration + m.alpha.cross(c) + m.omega.cross(m.omega.cross(c)));
  const Vector3d spin = link.inertia.cwiseProduct(m.omega);
  wrench.moment = link.inertia.cwiseProduct(m.alpha) + m.omega.cross(spin) + c.cross(wrench.force);
  return wrench;
}

/// Wrench about the origin of the frame before `joint`, in the axes of that frame.
BodyWrench carriedBack(const Isometry3d& joint, const BodyWrench& w) {
  const Vector3d force = joint.linear() * w.force;
  return {joint.linear() * w.moment + joint.translation().cross(force), force};
}

/// Rigid body: mass, and first moment and inertia about the origin of a frame.
struct Body {
  double mass = 0.0;
  Vector3d moment = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};

Matrix3d inertiaOf(double mass, const Vector3d& at) {
  return mass * (at.squaredNorm() * Matrix3d::Identity() - at * at.transpose());
}

Body bodyOf(const Link& link) {
  Matrix3d inertia = link.inertia.asDiagonal();
  inertia += inertiaOf(link.mass, link.centre_of_mass);
  return {link.mass, link.mass * link.centre_of_mass, inertia};
}

Body carriedBack(const Isometry3d& joint, const Body& body) {
  const Vector3d p = joint.translation();
  const Vector3d h = joint.linear() * body.moment;
  Body out;
  out.mass = body.mass;
  out.moment = h + body.mass * p;
  out.inertia = joint.linear() * body.inertia * joint.linear().transpose();
  out.inertia += 2.0 * p.dot(h) * Matrix3d::Identity() - p * h.transpose() - h * p.transpose();
  out.inertia += inertiaOf(body.mass, p);
  return out;
}

void add(Body& sum, const Body& body) {
  sum.mass += body.mass;
  sum.moment += body.moment;
  sum.inertia += body.inertia;
}

}  // namespace

ChainDynamics::ChainDynamics(const Description& description)
    : chain_(description), gravity_(description.gravity) {
  for (std::size_t i = 0; i < description.joints.size(); ++i) links_[i] = description.joints[i].link;
}

JointVector ChainDynamics::inverse(const JointVector& q, const JointVector& dq,
                                   const JointVector& ddq) const {
  const int n = size();
  CAPSTAN_ASSERT(q.size() == n && dq.size() == n && ddq.size() == n);
  std::array<Isometry3d, kMaxJoints> joints;
  std::array<BodyWrench, kMaxJoints> wrenches;
  Motion motion;
  motion.acceleration = -gravity_;  // gravity acts like an upward acceleration of the base
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    joints[at] = chain_.joint(i).at(q[i]);
    motion = moved(motion, joints[at], chain_.joint(i).revolute(), dq[i], ddq[i]);
    wrenches[at] = needed(links_[at], motion);
  }
  JointVector tau(n);
  for (int i = n - 1; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    tau[i] = chain_.joint(i).revolute() ? wrenches[at].moment.z() : wrenches[at].force.z();
    if (i == 0) break;
    const BodyWrench back = carriedBack(joints[at], wrenches[at]);
    wrenches[at - 1].moment += back.moment;
    wrenches[at - 1].force += back.force;
  }
  return tau;
}

JointVector ChainDynamics::bias(const JointVector& q, const JointVector& dq) const {
  return inverse(q, dq, JointVector::Zero(size()));
}

JointMatrix ChainDynamics::massMatrix(const JointVector& q) const {
  const int n = size();
  CAPSTAN_ASSERT(q.size() == n);
  std::array<Isometry3d, kMaxJoints> joints;
  for (int i = 0; i < n; ++i) joints[static_cast<std::size_t>(i)] = chain_.joint(i).at(q[i]);
  JointMatrix mass(n, n);
  Body beyond;  // all links that joint i moves, about the origin of frame i
  for (int i = n - 1; i >= 0; --i) {
    if (i < n - 1) beyond = carriedBack(joints[static_cast<std::size_t>(i) + 1], beyond);
    add(beyond, bodyOf(links_[static_cast<std::size_t>(i)]));
    const Vector3d axis = Vector3d::UnitZ();
    BodyWrench wrench;  // wrench of a unit acceleration of joint i
    if (chain_.joint(i).revolute())
      wrench = {beyond.inertia.col(2), axis.cross(beyond.moment)};
    else
      wrench = {beyond.moment.cross(axis), beyond.mass * axis};
    for (int j = i; j >= 0; --j) {
      mass(i, j) = chain_.joint(j).revolute() ? wrench.moment.z() : wrench.force.z();
      mass(j, i) = mass(i, j);
      wrench = carriedBack(joints[static_cast<std::size_t>(j)], wrench);
    }
  }
  return mass;
}

JointVector ChainDynamics::forward(const JointVector& q, const JointVector& dq,
                                   const JointVector& tau) const {
  const Eigen::LLT<JointMatrix> cholesky(massMatrix(q));
  JointVector ddq = tau - bias(q, dq);
  cholesky.solveInPlace(ddq);
  return ddq;
}

double ChainDynamics::kineticEnergy(const JointVector& q, const JointVector& dq) const {
  double energy = 0.0;
  Vector3d omega = Vector3d::Zero();
  Vector3d velocity = Vector3d::Zero();  // velocity of the frame's origin, in link axes
  for (int i = 0; i < size(); ++i) {
    const Link& link = links_[static_cast<std::size_t>(i)];
    const Isometry3d joint = chain_.joint(i).at(q[i]);
    velocity = joint.linear().transpose() * (velocity + omega.cross(joint.translation()));
    omega = joint.linear().transpose() * omega;
    (chain_.joint(i).revolute() ? omega : velocity).z() += dq[i];
    const Vector3d at_mass = velocity + omega.cross(link.centre_of_mass);
    energy += 0.5 * (link.mass * at_mass.squaredNorm() + omega.dot(link.inertia.cwiseProduct(omega)));
  }
  return energy;
}

double ChainDynamics::potentialEnergy(const JointVector& q) const {
  double energy = 0.0;
  Isometry3d pose = Isometry3d::Identity();
  for (int i = 0; i < size(); ++i) {
    const Link& link = links_[static_cast<std::size_t>(i)];
    pose = pose * chain_.joint(i).at(q[i]);
    energy -= link.mass * gravity_.dot(pose * link.centre_of_mass);
  }
  return energy;
}

}  // namespace capstan::robot
