#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// What a residual may depend on.
enum class VariableKind {
  kPosition,
  kDirection,  ///< −1, 0, +1: the joint moves back, rests, moves on
  kVelocity,
  kAcceleration,
  kMotorTorque,
  kJointTorque,   ///< of the drive or cable, simulated
  kLoad,          ///< measured external load
  kMotorAngle,    ///< modulo one turn of the motor
  kCapstanAngle,  ///< modulo one turn of the capstan behind the gear
  kStretch,       ///< of the cable, simulated
  kTime,
};

/// A number a row that signatures are drawn against. Motion is the simulated one: the measured one carries
/// the residual itself and the sensor's noise.
struct Variable {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;               ///< from 1; 0: of the whole recording
  std::string name;            ///< "motor angle of joint 2"
  std::string unit;            ///< SI; empty for a direction
  double period = 0.0;         ///< values that differ by it are the same; 0: none. `values` are not wrapped
  std::vector<double> values;  ///< a row each

  /// At the samples of a channel: linear between rows, a direction the nearest row's; wrapped to [0, period).
  std::vector<double> at(const Channel& channel) const;
};

/// All that evidence and simulation have of these, joints in order, time last. A joint rests where its speed
/// is below kRest of the 95 % quantile of its speed while it moves. Motor angles are measured, or, where the
/// robot has motors without encoders of their own (rigid drives), follow from the simulated joints.
/// Excluded: what never changes, and columns with values that are not finite.
std::vector<Variable> variablesOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                  const robot::Description& robot);
inline constexpr double kRest = 0.02;

/// Does `variable` belong to what a channel is shown against: all of the channel's own joint, positions and
/// directions of the others, time; of a camera's channel positions, directions, velocities and loads of all.
bool concerns(const Variable& variable, const Channel& channel);

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::VariableKind> {
  using K = capstan::diagnosis::VariableKind;
  static constexpr std::array value = {std::pair{K::kPosition, "position"},
                                       std::pair{K::kDirection, "direction"},
                                       std::pair{K::kVelocity, "velocity"},
                                       std::pair{K::kAcceleration, "acceleration"},
                                       std::pair{K::kMotorTorque, "motor_torque"},
                                       std::pair{K::kJointTorque, "joint_torque"},
                                       std::pair{K::kLoad, "load"},
                                       std::pair{K::kMotorAngle, "motor_angle"},
                                       std::pair{K::kCapstanAngle, "capstan_angle"},
                                       std::pair{K::kStretch, "stretch"},
                                       std::pair{K::kTime, "time"}};
};
