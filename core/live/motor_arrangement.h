#pragma once

#include "core/live/live_setup.h"
#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/robot/transmission.h"
#include "core/tracking/sample.h"

namespace capstan::live {

/// Which motor of the rows drives which joint, with which sign: motors and signs of a live set-up.
class MotorArrangement {
 public:
  /// `read_as`: units that the set-up states for the rows, which already are in SI.
  MotorArrangement(const RowsSetup& setup, robot::Description robot, recording::ReadAs read_as);

  void apply(tracking::MotorSample& sample) const;

  /// Judges the joint positions that the motors give by transmission kinematics, as medians over the rows.
  /// False: no joint could be judged, since the motors that move it have no finite position. Throws
  /// base::InputError for a joint outside its limits, widened to contain its hard stop and by kLimitMargin of
  /// its range, and for rows in radians that are read as degrees.
  ///
  /// The margin has room for cable stretch (up to about 2°) and for the arm at its limit; an offset of the
  /// homing beyond it is as wrong as an exchanged motor.
  bool check(const recording::MeasuredTable& rows) const;
  /// The same for rows in radians that are read as degrees alone.
  bool checkUnits(const recording::MeasuredTable& rows) const;
  /// Sentence about the joints that stand outside the same bounds by these rows; empty: none.
  std::string beyondLimits(const recording::MeasuredTable& rows) const;

  static constexpr double kLimitMargin = 0.1;  ///< share of the joint's range, as robot::ArmKinematics

 private:
  Eigen::Vector3d jointOf(const recording::MeasuredTable& rows, const Eigen::Vector3d& factor) const;
  bool isBeyond(int k, double q) const;
  void checkLimits(const recording::MeasuredTable& rows, const Eigen::Vector3d& q) const;
  void checkDegrees(const recording::MeasuredTable& rows, const Eigen::Vector3d& q) const;

  const std::array<int, 3> motors_;
  const std::array<double, 3> signs_;
  const robot::Description robot_;
  const robot::Transmission transmission_;
  const recording::ReadAs read_as_;
};

}  // namespace capstan::live
