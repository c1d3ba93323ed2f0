#pragma once

#include <string>
#include <vector>

#include "core/recording/measured_table.h"

namespace capstan::identification {

/// Recording of one cable-driven joint, SI: rows at an about constant step. All vectors have one length.
struct DriveRecording {
  std::string title;            ///< name of the source file
  std::vector<double> t;        ///< time, increasing [s]
  std::vector<double> q_m;      ///< motor position [rad]
  std::vector<double> dq_m;     ///< motor velocity [rad/s]
  std::vector<double> tau_m;    ///< motor torque [N·m]; NaN where not measured
  std::vector<double> tau_ext;  ///< load, positive towards positive q [N·m or N]
  std::vector<double> q;        ///< position by the joint encoder [rad or m]; NaN where not measured

  std::size_t size() const { return t.size(); }
};

/// Returns the recording of a one-joint table, thinned to rows `step` seconds apart. Motor velocity comes
/// from the table; where it is missing, it is the slope of a straight line through the motor positions within
/// `step` of the row. Rows without motor position or load are excluded. Throws base::InputError with file,
/// column and remedy when the table has more than one joint, q_m1, tau_ext1 or q1 is missing, or fewer than
/// two rows remain.
DriveRecording driveRecording(const recording::MeasuredTable& table, double step);

/// Sign of the recordings' tau_m: +1 where tau_m is the torque on the motor, as in the measured table; −1
/// where it is the reaction of the drive, as a torque cell between motor and drive may give. The drive is
/// passive, so ∫ tau_m dq_m over the recordings must be positive. +1 without tau_m.
double torqueSign(const std::vector<DriveRecording>& recordings);

}  // namespace capstan::identification
