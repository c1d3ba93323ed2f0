#pragma once

#include <functional>
#include <vector>

#include "core/robot/description.h"
#include "tests/support/planted/plant.h"

namespace capstan::test {

/// Motion of the plant, one row per millisecond.
struct PlantedMotion {
  std::vector<double> t;  ///< [s]
  std::vector<Joints> q, dq;
  std::vector<Joints> motor, motor_rate;                  ///< motor positions and velocities
  std::vector<Joints> motor_reading, motor_rate_reading;  ///< readings of the motor encoders
  std::vector<Joints> torque, load;                       ///< held from this row to the next
};

using JointPath = std::function<Joints(double t)>;

/// Options of drive().
struct DriveOptions {
  double duration = 30.0;  ///< duration of the motion [s]
  double settling = 1.0;   ///< time at rest before the first row [s]
};

/// Motion of the robot under its own 1 kHz controller: tau = K_p (desired − measured) + K_d (desired rate −
/// filtered rate) on motor encoder counts, critically damped, clipped at the torque limit and rounded to the
/// amplifier's resolution of 1e-5 N·m. The desired motor angle is that of the nominal robot with rigid
/// cables.
PlantedMotion drive(Plant& plant, const robot::Description& nominal, const std::vector<Planted>& effects,
                    const JointPath& wanted, const JointPath& load, const DriveOptions& options);

/// Open-loop simulation of a plant over a recorded motion: cable drives follow the recorded motor angles,
/// rigid drives the recorded torques; loads are those that the sensors measured. `restart`: rows after which
/// a rigid drive starts again from the recorded state; 0: never.
PlantedMotion replay(Plant& plant, const PlantedMotion& recorded, const std::vector<Planted>& effects,
                     std::size_t restart = 0);

/// Angle of the counts that the encoder of motor i has lost at t [rad]: motor position minus reading.
double slipOf(const std::vector<Planted>& effects, int i, double t, double duration);
/// True if the load sensor of joint i measures the magnitude alone.
bool tellsNoSign(const std::vector<Planted>& effects, int i);

}  // namespace capstan::test
