#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/robot/arm_dynamics.h"
#include "core/robot/description.h"
#include "core/simulation/extended_arm.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// Everything that moves.
struct PlantState {
  Eigen::Vector3d q_motor = Eigen::Vector3d::Zero();     ///< from the hard stop [rad]
  Eigen::Vector3d dq_motor = Eigen::Vector3d::Zero();    ///< [rad/s]
  Eigen::Vector3d q_link = Eigen::Vector3d::Zero();      ///< [rad, rad, m]
  Eigen::Vector3d dq_link = Eigen::Vector3d::Zero();     ///< [rad/s, rad/s, m/s]
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();  ///< Bouc–Wen z of each cable [m]
  Eigen::Vector3d loop = Eigen::Vector3d::Zero();        ///< that of a robot file's cable_hysteresis [m]
  Eigen::Vector3d creep = Eigen::Vector3d::Zero();       ///< of a robot file's cable_creep [m]
  double t = 0.0;  ///< from the begin of the recording, for a robot file's zero_drift [s]
};

/// The three-joint arm as the truth has it, UKF paper (2)–(8) with more:
///   I_m d²q_m = tau − tau_cm tanh(dq_m / v_eps) − tau_vm dq_m − r_mc gamma / N
///   M(q) d²q = Aᵀ (r_l ∘ gamma) − C dq − G − Stribeck friction
///   gamma = k_e (exp(a delta) − exp(−a delta)) + 2 b_e d(delta)/dt + stiffness_h z
/// with the effective r_l, changed k_e and b_e, and z of Bouc–Wen (truth.h). Rigid bodies are core/robot's;
/// the rest is the plant's own. RK4 on Truth::substeps steps a millisecond: the fastest rate, about 5e3/s,
/// times a step stays below 1. A robot file that lists effects is simulated with them (extended_arm.h). No
/// allocation.
class Plant {
 public:
  /// Throws base::InputError for a robot that is no three-joint remote-centre arm, or not cable-driven.
  Plant(const robot::Description& nominal, const Truth& truth);

  /// At rest with unstretched cables, `lead` [s] before the begin of the recording; the joints follow from
  /// the true transmission.
  void reset(const Eigen::Vector3d& q_motor, double lead = 0.0);
  void setState(const PlantState& state) { state_ = state; }
  /// Advances by `dt` [s] under constant motor torque [N·m], cut at the motors' limits.
  void step(const Eigen::Vector3d& torque, double dt);

  const PlantState& state() const { return state_; }
  Eigen::Vector3d cableForce() const;  ///< gamma [N]
  const Eigen::Vector3d& torqueLimit() const { return torque_limit_; }

 private:
  using Vector = Eigen::Matrix<double, 15, 1>;  // q_m, dq_m, q, dq, z
  Vector derivative(const Vector& x, const Eigen::Vector3d& torque) const;
  double force(int joint, double stretch, double stretch_rate, double z) const;
  ExtendedArm::Vector extendedState() const;

  robot::ArmDynamics dynamics_;
  std::array<robot::Friction, 3> motor_friction_, link_friction_;
  std::array<Stribeck, 3> stribeck_;
  std::array<Hysteresis, 3> hysteresis_;
  Eigen::Matrix3d travel_by_joint_;  // diag(r_l) A
  Eigen::Vector3d homing_, motor_radius_, motor_inertia_, torque_limit_, stiffness_, damping_, exponent_;
  std::optional<ExtendedArm> extended_;  ///< of a robot with effects
  double substep_;
  PlantState state_;
};

}  // namespace capstan::simulation
