#pragma once

#include <filesystem>
#include <string_view>

#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// True if the header line is that of a recording by the RAVEN-II's own software (mpos1_deg, …).
bool isRavenMotors(std::string_view header_line);

/// Imports a recording of the RAVEN-II's own software as a measured table.
///
/// Units and zeros of the software are those of robot::RavenSoftware; torque commands are not converted.
/// Joint columns become the reference q, marked as the robot's own kinematics (no truth). Throws
/// base::InputError like readMeasuredTable().
MeasuredTable readRavenMotors(const std::filesystem::path& path, const robot::Description& robot);

}  // namespace capstan::recording
