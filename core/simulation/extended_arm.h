#pragma once

#include <Eigen/Core>
#include <array>

#include "core/robot/chain/chain_model.h"
#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// Dynamics of an arm whose robot file lists effects, with a truth in addition. Each motor has an inertia of
/// its own; transmission, cables, friction and bodies follow the laws of robot/chain. The r_l of the truth
/// replaces the r_l of the file before effects act on it; hysteresis and Stribeck excess of the truth are
/// added.
///   I_m d²q_m = tau − tau_cm tanh(dq_m / v_eps) − tau_vm dq_m − (ds_m / dq_m) gamma
/// Effects of sensors (encoder_slip, sensor_sign, cameras) are not simulated here.
class ExtendedArm {
 public:
  ExtendedArm(const robot::Description& robot, const Truth& truth);

  /// Size of the state: q_m, dq_m, q, dq, Bouc–Wen z of the truth, z of the effects, creep; three of each.
  static constexpr int kStates = 21;
  using Vector = Eigen::Matrix<double, kStates, 1>;
  /// dx/dt of state `x` under motor `torque` [N·m]. `t` counts from the beginning of the recording [s].
  Vector derivative(double t, const Vector& x, const Eigen::Vector3d& torque) const;
  /// Cable forces gamma [N].
  Eigen::Vector3d cableForce(double t, const Vector& x) const;
  /// Joints [rad or m] with unstretched cables at motor angles `q_motor` [rad], before the recording begins.
  Eigen::Vector3d jointsFromMotors(const Eigen::Vector3d& q_motor) const;

  const robot::ChainModel& model() const { return model_; }

 private:
  struct Cables {
    Eigen::Vector3d force, lever, rate, loop_rate, creep_rate;
  };
  Cables cablesOf(double t, const Vector& x) const;
  double friction(int joint, const Vector& x, double drive) const;

  robot::ChainModel model_;
  std::array<Stribeck, 3> stribeck_;
  std::array<Hysteresis, 3> hysteresis_;
};

}  // namespace capstan::simulation
