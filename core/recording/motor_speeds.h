#pragma once

#include <cstddef>
#include <vector>

#include "core/recording/measured_table.h"

namespace capstan::recording {

/// Median time from row to row, in the unit of t; NaN with fewer than two rows.
double medianPeriod(const MeasuredTable& table);

/// Factor to SI, one per motor.
using MotorFactors = std::vector<double>;

/// Ratio of measured motor speeds to the rate of motor positions. For each motor it is the least-squares
/// slope of dq_m over the central difference of q_m on a window of kWindow rows to either side. It is 1 if
/// both have the same units, and 180/π if dq_m is in degrees per second and q_m in radians.
class MotorSpeeds {
 public:
  /// Computes the ratios; `position` and `time` are factors of q_m and t to SI.
  MotorSpeeds(const MeasuredTable& table, const MotorFactors& position, double time);

  /// Ratio of one motor; NaN if dq_m is missing, the motor hardly moves, or the correlation is below kAlike.
  double ratio(std::size_t motor) const { return motor < ratios_.size() ? ratios_[motor] : kNone; }
  /// True if any motor has a ratio.
  bool any() const;
  /// True if all existing ratios are between 1/3 and 3.
  bool agree() const;
  bool inDegrees(std::size_t motor) const { return ratio(motor) > 30.0 && ratio(motor) < 110.0; }

 private:
  static const double kNone;
  std::vector<double> ratios_;
};

}  // namespace capstan::recording
