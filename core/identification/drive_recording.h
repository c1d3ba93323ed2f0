#pragma once

#include <string>
#include <vector>

#include "core/recording/measured_table.h"

namespace capstan::identification {

/// What one cable-driven joint did: rows at about an even step, all vectors of one length, SI.
struct DriveRecording {
  std::string title;            ///< file it came from
  std::vector<double> t;        ///< rising [s]
  std::vector<double> q_m;      ///< motor position [rad]
  std::vector<double> dq_m;     ///< motor velocity [rad/s]
  std::vector<double> tau_m;    ///< motor torque [N·m]; NaN where not measured
  std::vector<double> tau_ext;  ///< load that pushes the joint towards positive q [N·m or N]
  std::vector<double> q;        ///< joint encoder, the reference [rad or m]; NaN where not measured

  std::size_t size() const { return t.size(); }
};

/// The recording of a table of one joint, thinned to rows `step` seconds apart. Motor velocity is the
/// table's, or else the slope of a straight line through the motor positions within `step` of the row. Rows
/// without motor position or load are excluded. Throws base::InputError naming file, column and remedy:
/// another number of joints than one, no q_m1, no tau_ext1, no q1, or less than two rows left.
DriveRecording driveRecording(const recording::MeasuredTable& table, double step);

/// +1 where tau_m drives the motor, as in the measured table; −1 where it is what the drive answers, as a
/// torque cell between motor and drive may count it. A passive drive takes energy in: ∫ tau_m dq_m over the
/// recordings is positive. +1 without tau_m.
double torqueSign(const std::vector<DriveRecording>& recordings);

}  // namespace capstan::identification
