#pragma once

#include <vector>

#include "tests/support/planted/effect.h"
#include "tests/support/planted/plant_parameters.h"

namespace capstan::test {

/// Blocks of the state, each one number a joint.
enum Block : std::size_t { kMotor, kMotorRate, kJoint, kJointRate, kHysteresis, kCreep, kBlocks };
using PlantState = std::array<Joints, kBlocks>;

/// What acts on the plant during one step.
struct PlantInput {
  Joints torque{};  ///< asked of the motors, held over the step [N·m or N]
  Joints load{};    ///< external load that pushes the joint towards positive q, held [N·m or N]
  /// Motors that move as measured, whatever their torque: position and velocity at the step's two ends,
  /// cubic in between. Null: the motors obey their own equation.
  const Joints* motor = nullptr;
  const Joints* motor_end = nullptr;
  const Joints* motor_rate = nullptr;
  const Joints* motor_rate_end = nullptr;
};

/// Motors, cables and links with planted effects. Cable drive (UKF paper 2–8):
///     gamma = k (e^{a δ} − e^{−a δ}) + 2 b dδ,   δ = r_mc q_m/N − r_l A (q − q_hs)
///     I_m ddq_m = tau − tau_c tanh(dq_m/v) − tau_v dq_m − (ds_m/dq_m) gamma
///     M ddq = Aᵀ (r_l ∘ gamma) − C dq − G − F_c tanh(dq/v) − F_v dq + tau_ext
/// Rigid drive: q_m = N/r_mc r_l A (q − q_hs) holds always, so that the motors' torque, friction and inertia
/// act on the joints. Classical Runge–Kutta steps of a fixed length far inside the stability limit.
class Plant {
 public:
  Plant(const PlantParameters& parameters, const std::vector<Planted>& effects);

  int size() const { return p_.size; }
  const PlantParameters& parameters() const { return p_; }
  /// At rest at `q`, the cables carrying gravity; t [s] does not matter.
  PlantState rest(const Joints& q);
  /// Motor positions that hold a rigid cable at `q` [rad].
  Joints motorsAt(const Joints& q) const;
  /// Steps of equal length into which `duration` [s] has to be cut; never fewer than two a millisecond.
  /// Throws std::invalid_argument where that would be more than a thousand a millisecond.
  int stepsFor(double duration, const Joints& q);
  /// State at t + duration from that at t, in `steps` steps.
  void advance(PlantState& state, double t, double duration, int steps, const PlantInput& input);
  /// Slope of the state at time t.
  PlantState slope(const PlantState& state, double t, const PlantInput& input);
  /// Kinetic and potential energy of motors, springs and links [J]; of cable pairs in nominal condition, and
  /// of zeros where the recording begins.
  double energy(const PlantState& state);

 private:
  struct CableState {
    double travel = 0.0, travel_rate = 0.0;  ///< of the motor's side
    double lever = 0.0;                      ///< d travel / d q_m
    double stretch = 0.0, rate = 0.0, range = 0.0;
  };

  CableState cableState(int i, const PlantState& s, double t) const;
  double tension(int i, const CableState& cable, const PlantState& s, PlantState& slope) const;
  double complianceTension(int i, const CableState& cable) const;
  double motorFriction(int i, double rate) const;
  double jointFriction(int i, double q, double dq, double drive) const;
  double outside(int i, double q, double t) const;
  double fastestRate(int i, const PlantState& s) const;
  bool stiff(int i) const { return p_.rigid && p_.compliance[i] == 0.0; }

  using ByJoint = std::array<std::vector<Planted>, kMostJoints>;
  PlantParameters p_;
  ByJoint travel_, zero_, cable_, friction_, outside_;
};

}  // namespace capstan::test
