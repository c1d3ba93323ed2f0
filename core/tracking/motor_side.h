#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/robot/fold_effects.h"
#include "core/robot/transmission.h"
#include "core/tracking/motor_reading.h"
#include "core/tracking/sample.h"
#include "core/tracking/time_series.h"

namespace capstan::tracking {

/// Motor-side measurements: q_m, dq_m (a difference over `span` seconds where none is measured), q_kin and
/// its history. For a robot with eccentric capstans, slipped encoders or drifting zeros, position() and
/// velocity() are corrected (MotorReading); measured() is not.
class MotorSide {
 public:
  /// Outcome of take(); kRestart: the sample was taken as the first of a new time line.
  enum class Taken { kRefused, kYes, kRestart };
  static constexpr int kRisingToRestart = 10;

  /// Keeps the last `capacity` samples.
  MotorSide(const robot::Description& robot, double span, std::size_t capacity)
      : reading_(robot),
        transmission_(robot::foldEffects(robot)),
        span_(span),
        motors_(capacity),
        joints_(capacity) {}

  void clear() {
    motors_.clear();
    joints_.clear();
    rising_ = 0;
  }

  /// Takes one sample. A sample is refused when its position is not finite or its time does not increase.
  /// After kRisingToRestart refused samples in succession with increasing times, the last one starts a new
  /// time line and earlier samples are forgotten; otherwise one stamp far in the future, or a clock that was
  /// set back, would end the session.
  Taken take(const MotorSample& sample) {
    if (!sample.position.allFinite() || !std::isfinite(sample.t)) return Taken::kRefused;
    Taken taken = Taken::kYes;
    if (!motors_.empty() && !(sample.t > motors_.newestTime())) {
      rising_ = rising_ > 0 && sample.t > last_refused_ ? rising_ + 1 : 1;
      last_refused_ = sample.t;
      if (rising_ < kRisingToRestart) return Taken::kRefused;
      clear();
      taken = Taken::kRestart;
    }
    rising_ = 0;
    const double before = motors_.empty() ? sample.t : motors_.newestTime();
    motors_.push(sample.t, sample.position);
    measured_ = sample;
    if (!sample.velocity.allFinite()) measured_.velocity = difference(sample.t, before);
    const MotorSample round = reading_.asRound(measured_);
    position_ = round.position;
    velocity_ = round.velocity;
    kinematic_ = transmission_.jointFromMotor(position_);
    joints_.push(sample.t, kinematic_);
    return taken;
  }

  /// Newest sample as measured; its velocity is a difference quotient where none was measured.
  const MotorSample& measured() const { return measured_; }
  const robot::Transmission& transmission() const { return transmission_; }
  const Eigen::Vector3d& position() const { return position_; }
  const Eigen::Vector3d& velocity() const { return velocity_; }
  const Eigen::Vector3d& kinematic() const { return kinematic_; }
  /// q_kin at an earlier time t [s]; the newest value holds for `hold` seconds.
  std::optional<Eigen::Vector3d> kinematicAt(double t, double hold) const { return joints_.at(t, hold); }

 private:
  /// Backward difference over span_, or over the last step where the history is shorter.
  Eigen::Vector3d difference(double t, double before) const {
    const double from = motors_.at(t - span_, 0.0) ? t - span_ : before;
    if (!(from < t)) return Eigen::Vector3d::Zero();
    return (measured_.position - *motors_.at(from, 0.0)) / (t - from);
  }

  MotorReading reading_;
  robot::Transmission transmission_;
  double span_;
  TimeSeries motors_, joints_;
  int rising_ = 0;  ///< number of successive refused samples with increasing times
  double last_refused_ = 0.0;
  MotorSample measured_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero(),
                  kinematic_ = Eigen::Vector3d::Zero();
};

}  // namespace capstan::tracking
