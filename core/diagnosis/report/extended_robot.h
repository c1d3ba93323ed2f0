#pragma once

#include <string>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Robot file of report.extended. Comments at its top list the recordings, the causes, smaller and background
/// effects, and the parameters that the refit changed. robot::parseDescription() restores the robot to the
/// last bit. `software` is the program and its version; empty: omitted.
std::string extendedRobotText(const Report& report, const std::string& software);

}  // namespace capstan::diagnosis
