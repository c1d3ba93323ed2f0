#pragma once

#include <stdexcept>
#include <vector>

#include "tests/support/planted/effect.h"
#include "tests/support/planted/plant_parameters.h"

namespace capstan::test {

/// Blocks of the state, each with one number per joint.
enum Block : std::size_t { kMotor, kMotorRate, kJoint, kJointRate, kHysteresis, kCreep, kBlocks };
using PlantState = std::array<Joints, kBlocks>;

/// Inputs of the plant during one step.
struct PlantInput {
  Joints torque{};  ///< commanded motor torque, held over the step [N·m or N]
  Joints load{};    ///< external load, positive towards positive q, held [N·m or N]
  /// Prescribed motion of the motors, independent of their torque: position and velocity at both ends of the
  /// step, cubic in between. Null: the motors follow their own equation of motion.
  const Joints* motor = nullptr;
  const Joints* motor_end = nullptr;
  const Joints* motor_rate = nullptr;
  const Joints* motor_rate_end = nullptr;
};

/// Thrown for a robot that is too stiff for the plant's time step.
class TooStiff : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Simulation of motors, cables and links with planted effects. Cable drive (UKF paper 2–8):
///     gamma = k (e^{a δ} − e^{−a δ}) + 2 b dδ,   δ = r_mc q_m/N − r_l A (q − q_hs)
///     I_m ddq_m = tau − tau_c tanh(dq_m/v) − tau_v dq_m − (ds_m/dq_m) gamma
///     M ddq = Aᵀ (r_l ∘ gamma) − C dq − G − F_c tanh(dq/v) − F_v dq + tau_ext
/// Rigid drive: q_m = N/r_mc r_l A (q − q_hs) always holds, so that the motors' torque, friction and inertia
/// act on the joints. Integration is by classical Runge–Kutta steps of fixed length, far inside the stability
/// limit. With cables, whose stiffness makes steps short, M and C dq + G are those of the position in the
/// middle of a step that the velocity predicts, C dq with the velocity at its begin.
class Plant {
 public:
  Plant(const PlantParameters& parameters, const std::vector<Planted>& effects);

  int size() const { return p_.size; }
  const PlantParameters& parameters() const { return p_; }
  /// State at rest at `q`, with cables that carry gravity.
  PlantState rest(const Joints& q);
  /// Motor positions that hold a rigid cable at `q` [rad].
  Joints motorsAt(const Joints& q) const;
  /// Number of equal integration steps that `duration` [s] needs, at least two per millisecond. Throws
  /// TooStiff if it needs more than a thousand per millisecond.
  int stepsFor(double duration, const Joints& q);
  /// Advances the state from t to t + duration in `steps` steps.
  void advance(PlantState& state, double t, double duration, int steps, const PlantInput& input);
  /// Time derivative of the state at time t.
  PlantState slope(const PlantState& state, double t, const PlantInput& input);
  /// Kinetic and potential energy of motors, springs and links [J], for cable pairs in nominal condition and
  /// for zeros as at the start of the recording.
  double energy(const PlantState& state);

 private:
  struct Bodies {
    RigidChain::Matrix mass;  ///< without what motors add
    Joints bias;              ///< C dq + G
  };
  struct CableState {
    double travel = 0.0, travel_rate = 0.0;  ///< cable travel and its rate on the motor's side
    double lever = 0.0;                      ///< d travel / d q_m
    double stretch = 0.0, rate = 0.0, range = 0.0;
  };

  Bodies bodiesAt(const Joints& q, const Joints& dq);
  PlantState slopeWith(const Bodies& bodies, const PlantState& state, double t,
                       const PlantInput& input) const;
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
