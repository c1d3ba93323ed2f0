#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/identification/drive_recording.h"
#include "core/robot/description.h"

namespace capstan::identification {

/// What becomes of the joint encoder's unknown zero.
enum class OffsetRule {
  kShared,  ///< one zero for all recordings, found in training; a held-out recording brings nothing of its
            ///< own
  kEach     ///< one zero for each recording, a held-out one too: the mean of its residuals
};

/// Angle residuals of some recordings under one model, seconds before `skip` excluded.
struct DriveScore {
  double rms = 0.0;              ///< over all rows of all recordings [rad or m]
  std::vector<double> file_rms;  ///< by recording
  std::vector<double> offset;    ///< what was taken off each recording [rad or m]; 0 with kShared
};

/// Residuals q − q_predicted by row, as many as the recording has; NaN where there is no encoder.
using DriveResiduals = std::vector<std::vector<double>>;

DriveScore scoreOf(const std::vector<DriveRecording>& recordings, const DriveResiduals& residuals,
                   OffsetRule rule, double skip);

/// Under the cable model of drive_model.h with the constants of `robot`.
DriveScore scoreDrive(const robot::Description& robot, const std::vector<DriveRecording>& recordings,
                      OffsetRule rule, double skip);

/// What a cable model has to beat: a straight line,
///     q = offset + gain q_m + compliance tau_m,
/// by least squares over the training recordings.
struct LinearDrive {
  double offset = 0.0;      ///< [rad or m]; 0 with OffsetRule::kEach
  double gain = 0.0;        ///< joint travel by motor travel
  double compliance = 0.0;  ///< [rad/(N·m)]: a linear stretch; 0: gear ratio alone
};

/// With `stretch`, rows without motor torque count with none.
LinearDrive fitLinear(const std::vector<DriveRecording>& training, bool stretch, OffsetRule rule,
                      double skip);
DriveScore scoreLinear(const LinearDrive& line, const std::vector<DriveRecording>& recordings,
                       OffsetRule rule, double skip);
/// The gear ratio of a robot file, by its transmission alone; with kShared the zero that suits `training`.
LinearDrive nominalLine(const robot::Description& robot, const std::vector<DriveRecording>& training,
                        OffsetRule rule, double skip);

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::OffsetRule> {
  using O = capstan::identification::OffsetRule;
  static constexpr std::array value = {std::pair{O::kShared, "shared"}, std::pair{O::kEach, "file"}};
};
