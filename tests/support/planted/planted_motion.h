#pragma once

#include <functional>
#include <vector>

#include "core/robot/description.h"
#include "tests/support/planted/plant.h"

namespace capstan::test {

/// What the plant did, a row a millisecond.
struct PlantedMotion {
  std::vector<double> t;  ///< [s]
  std::vector<Joints> q, dq;
  std::vector<Joints> motor, motor_rate;                  ///< where the motors are
  std::vector<Joints> motor_reading, motor_rate_reading;  ///< what their encoders tell
  std::vector<Joints> torque, load;                       ///< held from this row to the next
};

using JointPath = std::function<Joints(double t)>;

/// How the motors are driven and how finely the plant is cut.
struct DriveOptions {
  double duration = 30.0;  ///< [s]
  double settling = 1.0;   ///< the robot stands so long before the first row [s]
};

/// The robot under its own controller, 1 kHz: tau = K_p (wanted − read) + K_d (its rate − filtered rate), on
/// motor encoder counts, critically damped, cut at the torque limit and rounded to 1e-5 N·m as the amplifier
/// takes it. The wanted motor angle is that of a rigid cable of the nominal robot.
PlantedMotion drive(Plant& plant, const robot::Description& nominal, const std::vector<Planted>& effects,
                    const JointPath& wanted, const JointPath& load, const DriveOptions& options);

/// The same plant, or another, open loop over what was recorded: cable drives follow the motor angles, rigid
/// ones the torque; loads as their sensors tell them.
PlantedMotion replay(Plant& plant, const PlantedMotion& recorded, const std::vector<Planted>& effects);

/// Counts lost by the encoder of motor i at t, as an angle [rad]: the reading falls short of the motor by it.
double slipOf(const std::vector<Planted>& effects, int i, double t, double duration);
/// The load sensor of joint i tells the magnitude alone.
bool tellsNoSign(const std::vector<Planted>& effects, int i);

}  // namespace capstan::test
