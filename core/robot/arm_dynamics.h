#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "core/robot/arm_kernel.h"
#include "core/robot/arm_trig.h"
#include "core/robot/description.h"

namespace capstan::robot {

/// Computes the constants of the closed form (arm_kernel.h). Throws base::InputError when the arm has no
/// remote centre (remote_centre.h).
ArmConstants armConstants(const Description& description);

/// Rigid-body dynamics of a three-joint remote-centre arm, M(q) ddq + C(q, dq) dq + G(q) = tau, in closed
/// form (arm_kernel.h). q [rad, rad, m], tau [N·m, N·m, N]. T is double, long double or an
/// automatic-differentiation scalar with Eigen support. Without friction. No allocation.
class ArmDynamics {
 public:
  /// Throws base::InputError when the arm has no remote centre.
  explicit ArmDynamics(const Description& description) : constants_(armConstants(description)) {}

  template <class T>
  using Vector = Eigen::Matrix<T, 3, 1>;

  const ArmConstants& constants() const { return constants_; }

  template <class T>
  Eigen::Matrix<T, 3, 3> massMatrix(const Vector<T>& q) const {
    const ArmTerms<T> m = armTerms<T>(constants_, trigOf(q), q[2], {T(0.0), T(0.0), T(0.0)});
    Eigen::Matrix<T, 3, 3> matrix;
    matrix << m.m11, m.m12, m.m13, m.m12, m.m22, T(constants_.m23), m.m13, T(constants_.m23),
        T(constants_.m33);
    return matrix;
  }

  /// Inverse dynamics tau = M ddq + C dq + G.
  template <class T>
  Vector<T> inverse(const Vector<T>& q, const Vector<T>& dq, const Vector<T>& ddq) const {
    return vectorOf<T>(armInverse<T>(constants_, trigOf(q), q[2], arrayOf(dq), arrayOf(ddq)));
  }

  /// Bias C dq + G.
  template <class T>
  Vector<T> bias(const Vector<T>& q, const Vector<T>& dq) const {
    return vectorOf<T>(armTerms<T>(constants_, trigOf(q), q[2], arrayOf(dq)).bias);
  }

  /// Forward dynamics ddq = M⁻¹ (tau − C dq − G). tau: all joint torques (cables, friction, loads).
  template <class T>
  Vector<T> forward(const Vector<T>& q, const Vector<T>& dq, const Vector<T>& tau) const {
    return vectorOf<T>(armForward<T>(constants_, trigOf(q), q[2], arrayOf(dq), arrayOf(tau)));
  }

 private:
  template <class T>
  static ArmTrig<T> trigOf(const Vector<T>& q) {
    if constexpr (std::is_same_v<T, double>) {
      return armTrig(q[0], q[1]);
    } else {
      using std::cos;
      using std::sin;
      return {sin(q[0]), cos(q[0]), sin(q[1]), cos(q[1])};
    }
  }
  template <class T>
  static std::array<T, 3> arrayOf(const Vector<T>& v) {
    return {v[0], v[1], v[2]};
  }
  template <class T>
  static Vector<T> vectorOf(const std::array<T, 3>& v) {
    return {v[0], v[1], v[2]};
  }

  ArmConstants constants_;
};

}  // namespace capstan::robot
