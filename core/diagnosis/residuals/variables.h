#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// Kind of variable that a residual may depend on.
enum class VariableKind {
  kPosition,
  kDirection,  ///< direction of motion: −1, 0 at rest, +1
  kVelocity,
  kAcceleration,
  kMotorTorque,
  kJointTorque,   ///< simulated torque of the drive or cable at the joint
  kLoad,          ///< measured external load
  kMotorAngle,    ///< angle of the motor, modulo one revolution
  kCapstanAngle,  ///< angle of the capstan behind the gear, modulo one revolution
  kStretch,       ///< simulated stretch of the cable
  kTime,
};

/// Variable on which a residual may depend, one number per row (see Signature). Motion is taken from the
/// simulation of the recording, because measured motion contains the residual itself and the sensor's noise.
struct Variable {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;               ///< joint of the variable, from 1; 0: of the whole recording
  std::string name;            ///< "motor angle of joint 2"
  std::string unit;            ///< SI; empty for a direction
  double period = 0.0;         ///< period of an angle; 0: none. `values` are not wrapped
  std::vector<double> values;  ///< one entry per row

  /// Values at the samples of a channel, interpolated linearly between rows; a direction is the nearest
  /// row's, and periodic values are wrapped to [0, period).
  std::vector<double> at(const Channel& channel) const;
};

/// All variables that `evidence` and its simulation provide, kind by kind, joints in order, time last. A
/// joint is at rest where its speed is at most kRest × the 95 % quantile of its speed in motion. Motor angles
/// are measured; for motors without encoders (rigid drives) they follow from the simulated joints. Variables
/// that never change, or have values that are not finite, are excluded.
std::vector<Variable> variablesOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                  const robot::Description& robot);
inline constexpr double kRest = 0.02;

/// True if signatures of `channel` are computed against `variable`. For a joint encoder these are time, all
/// variables of its joint, and positions and directions of the other joints; for a camera channel they are
/// time, and positions, directions, velocities and loads of all joints.
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
