#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/identification/drive_recording.h"
#include "core/robot/description.h"

namespace capstan::identification {

/// Treatment of the unknown zero of the joint encoder.
enum class OffsetRule {
  kShared,  ///< one zero for all recordings, fitted in training; held-out recordings use it unchanged
  kEach     ///< one zero per recording, also for a held-out one: the mean of its residuals
};

/// RMS of the joint residuals of recordings under one model.
struct DriveScore {
  double rms = 0.0;              ///< RMS over all rows of all recordings [rad or m]
  std::vector<double> file_rms;  ///< RMS per recording [rad or m]
  std::vector<double> offset;    ///< zero subtracted from each recording [rad or m]; 0 with kShared
};

/// Residuals q − q_predicted per recording and row [rad or m]; NaN where the encoder has no value.
using DriveResiduals = std::vector<std::vector<double>>;

/// Score of `residuals`; the first `skip` seconds of each recording are excluded.
DriveScore scoreOf(const std::vector<DriveRecording>& recordings, const DriveResiduals& residuals,
                   OffsetRule rule, double skip);

/// Score of the cable model of drive_model.h with the constants of `robot`.
DriveScore scoreDrive(const robot::Description& robot, const std::vector<DriveRecording>& recordings,
                      OffsetRule rule, double skip);

/// Baseline model for the comparison with a cable model: a straight line,
///     q = offset + gain q_m + compliance tau_m.
struct LinearDrive {
  double offset = 0.0;      ///< encoder zero [rad or m]; 0 with OffsetRule::kEach
  double gain = 0.0;        ///< joint travel / motor travel
  double compliance = 0.0;  ///< linear stretch per motor torque [rad/(N·m)]; 0: gear ratio alone
};

/// Least-squares fit over the training recordings. `stretch`: the compliance is fitted too; a row without
/// motor torque then counts as torque 0.
LinearDrive fitLinear(const std::vector<DriveRecording>& training, bool stretch, OffsetRule rule,
                      double skip);
/// Score of the straight line `line`.
DriveScore scoreLinear(const LinearDrive& line, const std::vector<DriveRecording>& recordings,
                       OffsetRule rule, double skip);
/// Straight line with the gear ratio of the robot file, without compliance. With kShared its offset is the
/// mean over `training`.
LinearDrive nominalLine(const robot::Description& robot, const std::vector<DriveRecording>& training,
                        OffsetRule rule, double skip);

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::OffsetRule> {
  using O = capstan::identification::OffsetRule;
  static constexpr std::array value = {std::pair{O::kShared, "shared"}, std::pair{O::kEach, "file"}};
};
