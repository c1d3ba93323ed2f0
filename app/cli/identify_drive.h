#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/recording/column_units.h"
#include "core/robot/description.h"

namespace capstan::cli {

/// identify for a robot of one joint whose load was measured: measured tables with q_m1, tau_ext1, q1.
struct IdentifyDriveArguments {
  std::vector<std::string> files, held_out;
  std::string robot, parameters, out, json;
  recording::ReadAs read_as;     ///< units of the tables
  std::string offsets = "file";  ///< base::NamesOf<identification::OffsetRule>
};

/// Fits the cable model to `files`, states its errors there and in `held_out` beside those of straight lines,
/// writes the command. Throws base::InputError for files it cannot use.
ExitCode identifyDrive(const IdentifyDriveArguments& arguments, const robot::Description& nominal);

}  // namespace capstan::cli
