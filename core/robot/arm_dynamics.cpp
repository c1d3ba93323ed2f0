#include "core/robot/arm_dynamics.h"

#include <Eigen/Geometry>

#include "core/robot/remote_centre.h"

namespace capstan::robot {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotX(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); }
Matrix3d rotZ(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

/// Matrix a·b I − (a bᵀ + b aᵀ)/2. With a = b = r it is the inertia of a unit mass at r.
Matrix3d pointInertia(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) * Matrix3d::Identity() - 0.5 * (a * b.transpose() + b * a.transpose());
}

/// Computes the quadratics of M from the coefficients of J(q3) = J_0 + q3 J_1 + q3² J_2, frame B.
void setMassMatrix(ArmConstants& k, double inertia1, const std::array<Matrix3d, 3>& inertia) {
  const double square = k.sin_alpha2 * k.sin_alpha2;
  const auto quadratic = [&](auto term) {
    return Quadratic{term(inertia[0]), term(inertia[1]), term(inertia[2])};
  };
  k.a = quadratic([&](const Matrix3d& j) {
    return 0.5 * square * (j(0, 0) + j(1, 1)) + k.cos_alpha2 * k.cos_alpha2 * j(2, 2);
  });
  k.a.value += inertia1;
  k.b = quadratic([&](const Matrix3d& j) { return 0.5 * square * (j(1, 1) - j(0, 0)); });
  k.c = quadratic([&](const Matrix3d& j) { return square * j(0, 1); });
  k.f = quadratic([&](const Matrix3d& j) { return k.sin_alpha2 * j(0, 2); });
  k.g = quadratic([&](const Matrix3d& j) { return k.sin_alpha2 * j(1, 2); });
  k.n = quadratic([&](const Matrix3d& j) { return j(2, 2); });
}

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
  const double inertia1 = first.link.inertia.z() + first.link.mass * (c1.x() * c1.x() + c1.y() * c1.y());
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
  setMassMatrix(k, inertia1,
                {own2 + m2 * pointInertia(c2, c2) + own3 + m3 * pointInertia(c0, c0),
                 2.0 * m3 * pointInertia(c0, u), m3 * pointInertia(u, u)});
  const Vector3d cross = m3 * c0.cross(u);
  k.p = k.sin_alpha2 * cross.x();
  k.q = k.sin_alpha2 * cross.y();
  k.r = k.cos_alpha2 * cross.z();
  k.m23 = cross.z();
  k.m33 = m3;
  k.inverse_m33 = 1.0 / m3;
  k.moment = packed(Vector3d(m2 * c2 + m3 * c0));
  k.sliding_moment = packed(Vector3d(m3 * u));
  return k;
}

}  // namespace capstan::robot
