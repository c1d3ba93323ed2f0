#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// `value` rounded to the nearest multiple of `step`; a step of 0 changes nothing.
inline double quantised(double value, double step) {
  return step > 0.0 ? std::round(value / step) * step : value;
}

/// Incremental encoders on the motor shafts, read at 1 kHz. Ideal encoders return the state itself. Real ones
/// return counts; their velocity is the difference quotient dq/dt of the counts after the low pass
///   v += (1 − exp(−2 pi f_c dt)) (dq/dt − v).
class MotorEncoders {
 public:
  MotorEncoders(const robot::Description& robot, const EncoderTruth& truth, double dt)
      : dt_(dt), gain_(1.0 - std::exp(-2.0 * std::numbers::pi * truth.velocity_cutoff * dt)) {
    for (int i = 0; i < 3; ++i)
      step_[i] = 2.0 * std::numbers::pi / robot.drives[static_cast<std::size_t>(i)].encoder_counts;
    if (!truth.motor_quantised) step_.setZero();
  }

  void reset(const Eigen::Vector3d& q_motor) {
    position_ = counted(q_motor);
    velocity_.setZero();
  }

  /// Reads the motors at one tick: `q_motor` [rad], `dq_motor` [rad/s].
  void read(const Eigen::Vector3d& q_motor, const Eigen::Vector3d& dq_motor) {
    const Eigen::Vector3d now = counted(q_motor);
    velocity_ = step_.isZero(0.0)
                    ? dq_motor
                    : Eigen::Vector3d(velocity_ + gain_ * ((now - position_) / dt_ - velocity_));
    position_ = now;
  }

  const Eigen::Vector3d& position() const { return position_; }  ///< measured position [rad]
  const Eigen::Vector3d& velocity() const { return velocity_; }  ///< measured velocity [rad/s]

 private:
  Eigen::Vector3d counted(const Eigen::Vector3d& q) const {
    return {quantised(q[0], step_[0]), quantised(q[1], step_[1]), quantised(q[2], step_[2])};
  }

  double dt_, gain_;
  Eigen::Vector3d step_;  // angle per count [rad]; 0: exact
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace capstan::simulation
