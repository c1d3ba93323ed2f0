#pragma once

#include <cstddef>
#include <vector>

#include "core/recording/measured_table.h"

namespace capstan::recording {

/// Median time from row to row, as t stands; NaN with fewer than two rows.
double medianPeriod(const MeasuredTable& table);

/// A factor to SI a motor.
using MotorFactors = std::vector<double>;

/// Measured motor speeds beside those at which motor positions change: for each motor the slope of dq_m over
/// the central difference of q_m on a window of kWindow rows, by least squares. 1 where both are in the same
/// units, 180/π where dq_m is in degrees per second and q_m in radians.
class MotorSpeeds {
 public:
  /// `position` and `time`: factors of q_m and t to SI.
  MotorSpeeds(const MeasuredTable& table, const MotorFactors& position, double time);

  /// NaN: dq_m is missing, the motor hardly moves, or both are not alike (correlation below kAlike).
  double ratio(std::size_t motor) const { return motor < ratios_.size() ? ratios_[motor] : kNone; }
  /// Is there a ratio of some motor?
  bool any() const;
  /// All ratios that there are lie between a third and three.
  bool agree() const;
  bool inDegrees(std::size_t motor) const { return ratio(motor) > 30.0 && ratio(motor) < 110.0; }

 private:
  static const double kNone;
  std::vector<double> ratios_;
};

}  // namespace capstan::recording
