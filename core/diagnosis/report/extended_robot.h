#pragma once

#include <string>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// The robot file of report.extended, with comments on top that say from which recordings it is, what was
/// named and which numbers the refit moved: robot::parseDescription() gives the robot back to the last bit.
/// `software`: program and version; empty: not said.
std::string extendedRobotText(const Report& report, const std::string& software);

}  // namespace capstan::diagnosis
