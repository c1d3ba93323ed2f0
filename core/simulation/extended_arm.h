#pragma once

#include <Eigen/Core>
#include <array>

#include "core/robot/chain/chain_model.h"
#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// The arm of a robot file that lists effects, with a truth besides: motors of their own inertia, and behind
/// them transmission, cables, friction and bodies by the laws of robot/chain. A truth's r_l takes the place
/// of the file's before effects act on it; its hysteresis and Stribeck excess come on top.
///   I_m d²q_m = tau − tau_cm tanh(dq_m / v_eps) − tau_vm dq_m − (ds_m / dq_m) gamma
/// What sensors make of it (encoder_slip, sensor_sign, cameras) is not the arm's.
class ExtendedArm {
 public:
  ExtendedArm(const robot::Description& robot, const Truth& truth);

  /// q_m, dq_m, q, dq, Bouc–Wen z of the truth, z of the effects, creep.
  static constexpr int kStates = 21;
  using Vector = Eigen::Matrix<double, kStates, 1>;
  /// t from the begin of the recording [s].
  Vector derivative(double t, const Vector& x, const Eigen::Vector3d& torque) const;
  /// gamma [N].
  Eigen::Vector3d cableForce(double t, const Vector& x) const;
  /// Joints that unstretched cables give before the begin of the recording [rad or m].
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
