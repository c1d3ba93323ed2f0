#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/robot/arm_dynamics.h"
#include "core/robot/description.h"
#include "core/simulation/extended_arm.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// State of the plant.
struct PlantState {
  Eigen::Vector3d q_motor = Eigen::Vector3d::Zero();     ///< motor angles from the hard stop [rad]
  Eigen::Vector3d dq_motor = Eigen::Vector3d::Zero();    ///< motor velocities [rad/s]
  Eigen::Vector3d q_link = Eigen::Vector3d::Zero();      ///< joints [rad, rad, m]
  Eigen::Vector3d dq_link = Eigen::Vector3d::Zero();     ///< joint velocities [rad/s, rad/s, m/s]
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();  ///< Bouc–Wen z of each cable [m]
  Eigen::Vector3d loop = Eigen::Vector3d::Zero();        ///< Bouc–Wen z of the effect cable_hysteresis [m]
  Eigen::Vector3d creep = Eigen::Vector3d::Zero();       ///< creep elongation of the effect cable_creep [m]
  double t = 0.0;  ///< time from the beginning of the recording, for the effect zero_drift [s]
};

/// Dynamics of the true three-joint arm: UKF paper (2)–(8), extended by hysteresis and Stribeck friction:
///   I_m d²q_m = tau − tau_cm tanh(dq_m / v_eps) − tau_vm dq_m − r_mc gamma / N
///   M(q) d²q = Aᵀ (r_l ∘ gamma) − C dq − G − Stribeck friction
///   gamma = k_e (exp(a delta) − exp(−a delta)) + 2 b_e d(delta)/dt + stiffness_h z
/// with the effective r_l, changed k_e and b_e, and z of Bouc–Wen (truth.h). Only the rigid-body dynamics are
/// shared with core/robot. RK4 takes Truth::substeps steps per millisecond, so that the fastest rate, about
/// 5e3/s, times a step is below 1. A robot file that lists effects is simulated with them (extended_arm.h).
/// No allocation.
class Plant {
 public:
  /// Throws base::InputError unless the robot is a cable-driven three-joint remote-centre arm.
  Plant(const robot::Description& nominal, const Truth& truth);

  /// Sets a state of rest with unstretched cables, `lead` [s] before the recording begins. The true
  /// transmission gives the joints from motor angles `q_motor` [rad].
  void reset(const Eigen::Vector3d& q_motor, double lead = 0.0);
  void setState(const PlantState& state) { state_ = state; }
  /// Advances by `dt` [s] under a constant motor torque [N·m], which is limited to the motors' torque limits.
  void step(const Eigen::Vector3d& torque, double dt);

  const PlantState& state() const { return state_; }
  Eigen::Vector3d cableForce() const;                                   ///< cable forces gamma [N]
  const Eigen::Vector3d& torqueLimit() const { return torque_limit_; }  ///< [N·m]

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
  std::optional<ExtendedArm> extended_;  ///< dynamics of a robot file that lists effects
  double substep_;
  PlantState state_;
};

}  // namespace capstan::simulation
