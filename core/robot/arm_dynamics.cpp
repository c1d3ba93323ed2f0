#include "core/robot/arm_dynamics.h"

#include <Eigen/Geometry>

#include "core/robot/remote_centre.h"

namespace capstan::robot {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotX(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); }
Matrix3d rotZ(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

/// a·b I − (a bᵀ + b aᵀ)/2: with a = b = r, the inertia of a unit mass at r.
Matrix3d pointInertia(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) * Matrix3d::Identity() - 0.5 * (a * b.transpose() + b * a.transpose());
}

Symmetric packed(const Matrix3d& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }
std::array<double, 3> packed(const Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

ArmConstants armConstants(const Description& description) {
  requireRemoteCentreArm(description);
  const Joint& first = description.joints[0];
  const Joint& second = description.joints[1];
  const Joint& third = description.joints[2];
  ArmConstants k;
  k.sin_alpha2 = std::sin(second.dh.alpha);
  k.cos_alpha2 = std::cos(second.dh.alpha);
  k.gravity =
      packed(Vector3d((rotX(first.dh.alpha) * rotZ(first.dh.theta)).transpose() * description.gravity));

  const Vector3d& c1 = first.link.centre_of_mass;
  k.inertia1 = first.link.inertia.z() + first.link.mass * (c1.x() * c1.x() + c1.y() * c1.y());
  k.moment1 = {first.link.mass * c1.x(), first.link.mass * c1.y()};

  const Matrix3d b_from_2 = rotZ(second.dh.theta);
  const Matrix3d b_from_3 = b_from_2 * rotX(third.dh.alpha) * rotZ(third.dh.theta);
  const Vector3d u = b_from_3.col(2);
  const Vector3d c2 = b_from_2 * second.link.centre_of_mass;
  const Vector3d c0 = b_from_3 * third.link.centre_of_mass + third.dh.d * u;
  const double m2 = second.link.mass;
  const double m3 = third.link.mass;
  const Matrix3d own2 = b_from_2 * second.link.inertia.asDiagonal() * b_from_2.transpose();
  const Matrix3d own3 = b_from_3 * third.link.inertia.asDiagonal() * b_from_3.transpose();
  k.j0 = packed(Matrix3d(own2 + m2 * pointInertia(c2, c2) + own3 + m3 * pointInertia(c0, c0)));
  k.j1 = packed(Matrix3d(2.0 * m3 * pointInertia(c0, u)));
  k.j2 = packed(Matrix3d(m3 * pointInertia(u, u)));
  k.moment = packed(Vector3d(m2 * c2 + m3 * c0));
  k.sliding_moment = packed(Vector3d(m3 * u));
  k.cross = packed(Vector3d(m3 * c0.cross(u)));
  k.mass3 = m3;
  k.inverse_mass3 = 1.0 / m3;
  return k;
}

}  // namespace capstan::robot
