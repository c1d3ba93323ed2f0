#include "tests/support/planted/rigid_chain.h"

#include <Eigen/Geometry>
#include <cmath>

namespace capstan::test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RigidChain::RigidChain(const robot::Description& robot) : size_(robot.size()), gravity_(robot.gravity) {
  for (int i = 0; i < size_; ++i) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    Body& body = bodies_[i];
    body.dh = joint.dh;
    body.turns = joint.type == robot::JointType::kRevolute;
    body.cos_alpha = std::cos(joint.dh.alpha);
    body.sin_alpha = std::sin(joint.dh.alpha);
    body.mass = joint.link.mass;
    body.centre = joint.link.centre_of_mass;
    body.inertia = joint.link.inertia.asDiagonal();
  }
  pose(Joints{});
}

void RigidChain::pose(const Joints& q) {
  for (int i = 0; i < size_; ++i) {
    const Body& b = bodies_[i];
    const double theta = b.dh.theta + (b.turns ? q[i] : 0.0), d = b.dh.d + (b.turns ? 0.0 : q[i]);
    const double c = std::cos(theta), s = std::sin(theta), ca = b.cos_alpha, sa = b.sin_alpha;
    rotation_[i] << c, -s, 0.0, s * ca, c * ca, -sa, s * sa, c * sa, ca;
    origin_[i] << b.dh.a, -sa * d, ca * d;
  }
}

Joints RigidChain::recursion(const Joints& dq, const Joints& ddq, const Vector3d& gravity) const {
  std::array<Vector3d, kMostJoints> force, moment;
  Vector3d w = Vector3d::Zero(), dw = Vector3d::Zero(), a = -gravity;
  for (int i = 0; i < size_; ++i) {
    const Body& b = bodies_[i];
    const Vector3d& p = origin_[i];
    a = rotation_[i].transpose() * (a + dw.cross(p) + w.cross(w.cross(p)));
    w = rotation_[i].transpose() * w;
    dw = rotation_[i].transpose() * dw;
    const Vector3d along(0.0, 0.0, dq[i]);
    if (b.turns) {
      dw += Vector3d(0.0, 0.0, ddq[i]) + w.cross(along);
      w += along;
    } else {
      a += Vector3d(0.0, 0.0, ddq[i]) + 2.0 * w.cross(along);
    }
    force[i] = b.mass * (a + dw.cross(b.centre) + w.cross(w.cross(b.centre)));
    moment[i] = b.inertia * dw + w.cross(b.inertia * w) + b.centre.cross(force[i]);
  }
  Joints tau{};
  Vector3d f = Vector3d::Zero(), n = Vector3d::Zero();
  for (int i = size_ - 1; i >= 0; --i) {
    f += force[i];
    n += moment[i];
    tau[i] = bodies_[i].turns ? n.z() : f.z();
    f = rotation_[i] * f;
    n = rotation_[i] * n + origin_[i].cross(f);
  }
  return tau;
}

RigidChain::Matrix RigidChain::massMatrix() const {
  Matrix m{};
  std::array<Vector3d, kMostJoints> force, moment;
  for (int j = 0; j < size_; ++j) {  // unit acceleration of joint j alone: links before it stand still
    Vector3d a = Vector3d::Zero(), dw = Vector3d::Zero();
    (bodies_[j].turns ? dw : a).z() = 1.0;
    for (int i = j; i < size_; ++i) {
      const Body& b = bodies_[i];
      if (i > j) {
        a = rotation_[i].transpose() * (a + dw.cross(origin_[i]));
        dw = rotation_[i].transpose() * dw;
      }
      force[i] = b.mass * (a + dw.cross(b.centre));
      moment[i] = b.inertia * dw + b.centre.cross(force[i]);
    }
    Vector3d f = Vector3d::Zero(), n = Vector3d::Zero();
    for (int i = size_ - 1; i >= 0; --i) {
      if (i >= j) {
        f += force[i];
        n += moment[i];
      }
      if (i <= j) m[i][j] = m[j][i] = bodies_[i].turns ? n.z() : f.z();
      f = rotation_[i] * f;
      n = rotation_[i] * n + origin_[i].cross(f);
    }
  }
  return m;
}

Vector3d RigidChain::point(const Vector3d& in_last) const {
  Vector3d p = in_last;
  for (int i = size_ - 1; i >= 0; --i) p = rotation_[i] * p + origin_[i];
  return p;
}

double RigidChain::energy(const Joints& dq) const {
  const Matrix m = massMatrix();
  double kinetic = 0.0, potential = 0.0;
  for (int i = 0; i < size_; ++i)
    for (int j = 0; j < size_; ++j) kinetic += 0.5 * dq[i] * m[i][j] * dq[j];
  Matrix3d orientation = Matrix3d::Identity();
  Vector3d at = Vector3d::Zero();
  for (int i = 0; i < size_; ++i) {
    at += orientation * origin_[i];
    orientation = orientation * rotation_[i];
    potential -= bodies_[i].mass * gravity_.dot(at + orientation * bodies_[i].centre);
  }
  return kinetic + potential;
}

void RigidChain::addPointMass(int i, double mass, const Vector3d& at) {
  Body& body = bodies_[i];
  const double total = body.mass + mass;
  if (total <= 0.0 || mass == 0.0) return;
  const Vector3d arm = at - body.centre;
  const double reduced = body.mass * mass / total;
  body.inertia += reduced * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
  body.centre += mass / total * arm;
  body.mass = total;
}

Joints solveSymmetric(RigidChain::Matrix a, const Joints& b, int n) {
  Joints x = b;
  for (int j = 0; j < n; ++j)  // a becomes L below the diagonal, D on it
    for (int i = j + 1; i < n; ++i) {
      const double l = a[i][j] / a[j][j];
      for (int k = j + 1; k <= i; ++k) a[i][k] -= l * a[k][j];
      x[i] -= l * x[j];
    }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= a[k][i] * x[k];
    x[i] /= a[i][i];
  }
  return x;
}

}  // namespace capstan::test
