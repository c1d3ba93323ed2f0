#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "core/robot/description.h"

namespace capstan::test {

/// Reference implementation of the UKF paper's cable arm, (5)–(10), in any precision T: Newton–Euler
/// recursion over the Denavit–Hartenberg table, mass matrix column by column, exp(aδ) − exp(−aδ) without
/// simplification. It is written for readability and shares no code with the library.
template <class T>
class CableArmReference {
 public:
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using Matrix3 = Eigen::Matrix<T, 3, 3>;
  using State = Eigen::Matrix<T, 6, 1>;
  struct Motor {
    Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
  };

  explicit CableArmReference(const robot::Description& robot) : robot_(robot) {}

  /// Inverse dynamics tau = M ddq + C dq + G, without friction.
  Vector3 inverse(const Vector3& q, const Vector3& dq, const Vector3& ddq) const {
    std::array<Matrix3, 3> rotation;  // from link i to its parent
    std::array<Vector3, 3> origin;    // of link i in its parent
    std::array<Vector3, 3> force, moment;
    Vector3 omega = Vector3::Zero(), alpha = Vector3::Zero(), a = -robot_.gravity.cast<T>();
    const Vector3 z = Vector3::UnitZ();
    for (std::size_t i = 0; i < 3; ++i) {
      const robot::Joint& joint = robot_.joints[i];
      const int j = static_cast<int>(i);
      const bool turns = joint.type == robot::JointType::kRevolute;
      place(joint.dh, turns ? q(j) : T(0), turns ? T(0) : q(j), rotation[i], origin[i]);
      const Matrix3 down = rotation[i].transpose();
      a = down * (a + alpha.cross(origin[i]) + omega.cross(omega.cross(origin[i])));
      const Vector3 carried = down * omega;
      alpha = down * alpha;
      omega = carried;
      if (turns) {
        omega += z * dq(j);
        alpha += z * ddq(j) + carried.cross(Vector3(z * dq(j)));
      } else {
        a += z * ddq(j) + T(2) * omega.cross(Vector3(z * dq(j)));
      }
      const Vector3 c = joint.link.centre_of_mass.cast<T>();
      const Vector3 at_centre = a + alpha.cross(c) + omega.cross(omega.cross(c));
      const Vector3 inertia = joint.link.inertia.cast<T>();
      force[i] = T(joint.link.mass) * at_centre;
      moment[i] =
          inertia.cwiseProduct(alpha) + omega.cross(Vector3(inertia.cwiseProduct(omega))) + c.cross(force[i]);
    }
    Vector3 tau;
    Vector3 f = Vector3::Zero(), n = Vector3::Zero();
    for (int i = 2; i >= 0; --i) {
      const std::size_t k = static_cast<std::size_t>(i);
      f += force[k];
      n += moment[k];
      tau(i) = robot_.joints[k].type == robot::JointType::kRevolute ? n(2) : f(2);
      f = rotation[k] * f;
      n = rotation[k] * n + origin[k].cross(f);
    }
    return tau;
  }

  Matrix3 massMatrix(const Vector3& q) const {
    const Vector3 none = Vector3::Zero();
    const Vector3 rest = inverse(q, none, none);
    Matrix3 m;
    for (int j = 0; j < 3; ++j) m.col(j) = inverse(q, none, Vector3::Unit(j)) - rest;
    return m;
  }

  State derivative(const State& x, const Motor& motor) const {
    using std::exp;
    using std::tanh;
    const Vector3 q(x(0), x(2), x(4)), dq(x(1), x(3), x(5));
    Matrix3 coupling;
    Vector3 radius, homing, friction, tension;
    for (int i = 0; i < 3; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      for (int j = 0; j < 3; ++j) coupling(i, j) = T(robot_.coupling[k][static_cast<std::size_t>(j)]);
      radius(i) = T(robot_.drives[k].link_radius);
      homing(i) = T(robot_.joints[k].homing);
      const robot::Friction& f = robot_.joints[k].friction;
      friction(i) = T(f.coulomb) * tanh(dq(i) / T(f.smoothing)) + T(f.viscous) * dq(i);
    }
    const Vector3 link_travel = radius.cwiseProduct(coupling * (q - homing));
    const Vector3 link_rate = radius.cwiseProduct(coupling * dq);
    for (int i = 0; i < 3; ++i) {
      const robot::Drive& drive = robot_.drives[static_cast<std::size_t>(i)];
      const T scale = T(drive.motor_capstan_radius) / T(drive.gear_ratio);
      const T delta = scale * motor.position(i) - link_travel(i);
      const T rate = scale * motor.velocity(i) - link_rate(i);
      const T a = T(drive.cable_exponent);
      tension(i) = T(drive.cable_stiffness) * (exp(a * delta) - exp(-a * delta)) +
                   T(2) * T(drive.cable_damping) * rate;
    }
    const Vector3 torque = coupling.transpose() * radius.cwiseProduct(tension) - friction;
    const Vector3 ddq = massMatrix(q).inverse() * (torque - inverse(q, dq, Vector3::Zero()));
    State slope;
    slope << dq(0), ddq(0), dq(1), ddq(1), dq(2), ddq(2);
    return slope;
  }

  /// State after dt, by `steps` classical RK4 steps; the motor moves linearly from `begin` to `end`.
  State propagate(State x, const Motor& begin, const Motor& end, T dt, int steps) const {
    const T h = dt / T(steps);
    const auto motorAt = [&](T s) {
      return Motor{begin.position + s * (end.position - begin.position),
                   begin.velocity + s * (end.velocity - begin.velocity)};
    };
    for (int i = 0; i < steps; ++i) {
      const Motor first = motorAt(T(i) / T(steps)), middle = motorAt((T(i) + T(0.5)) / T(steps)),
                  last = motorAt(T(i + 1) / T(steps));
      const State k1 = derivative(x, first);
      const State k2 = derivative(State(x + h / T(2) * k1), middle);
      const State k3 = derivative(State(x + h / T(2) * k2), middle);
      const State k4 = derivative(State(x + h * k3), last);
      x += h / T(6) * (k1 + T(2) * k2 + T(2) * k3 + k4);
    }
    return x;
  }

 private:
  static void place(const robot::DhRow& dh, T turn, T slide, Matrix3& rotation, Vector3& origin) {
    using std::cos;
    using std::sin;
    const T ca = cos(T(dh.alpha)), sa = sin(T(dh.alpha));
    const T ct = cos(T(dh.theta) + turn), st = sin(T(dh.theta) + turn);
    rotation << ct, -st, T(0), st * ca, ct * ca, -sa, st * sa, ct * sa, ca;
    const T d = T(dh.d) + slide;
    origin << T(dh.a), -sa * d, ca * d;
  }

  robot::Description robot_;
};

}  // namespace capstan::test
