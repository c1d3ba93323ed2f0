#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/identify_drive_output.h"
#include "core/base/progress.h"
#include "core/recording/column_units.h"
#include "core/robot/description.h"

namespace capstan::cli {

/// Arguments of `identify` for a robot of one joint with measured load: tables with q_m1, tau_ext1, q1.
struct IdentifyDriveArguments {
  std::vector<std::string> files, held_out;
  std::string robot, parameters, out, json;
  recording::ReadAs read_as;     ///< units of the tables
  std::string offsets = "file";  ///< encoder zeros, by base::NamesOf<identification::OffsetRule>
};

/// Options of the fit that `arguments` choose.
identification::DriveOptions driveOptionsOf(const IdentifyDriveArguments& arguments);

/// Fits the cable model to `training`, and computes its errors beside those of linear models. Returns nothing
/// if `progress` was cancelled. Throws base::InputError for unusable parameters and recordings.
std::optional<DriveFindings> driveFindings(const IdentifyDriveArguments& arguments,
                                           const robot::Description& nominal,
                                           const std::vector<identification::DriveRecording>& training,
                                           const std::vector<identification::DriveRecording>& held_out,
                                           base::Progress& progress);

/// Text of the robot file with the identified drive.
std::string identifiedRobotText(const robot::Description& nominal, const DriveFindings& findings,
                                const std::vector<identification::DriveRecording>& training);

/// Fits the cable model to `files`, prints its errors on `files` and `held_out` beside those of linear
/// models, and writes the outputs. Throws base::InputError for unusable files.
ExitCode identifyDrive(const IdentifyDriveArguments& arguments, const robot::Description& nominal);

}  // namespace capstan::cli
