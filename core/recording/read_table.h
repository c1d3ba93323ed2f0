#pragma once

#include <filesystem>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// True if `path` is a session file by its suffix or its first bytes. Throws base::InputError if it cannot be
/// opened.
bool isSession(const std::filesystem::path& path);

/// True if `path` is a ROS bag by its first bytes. Throws as isSession().
bool isBag(const std::filesystem::path& path);

/// Reads the measured table, the ROS bag (ros1::openBag()), or the recording by the RAVEN-II's own software,
/// at `path`, in SI units. All parts of the program read tables by this function. `read_as` states the units
/// of a measured table; a RAVEN-II recording states its own. Throws ImplausibleUnits for columns that are
/// implausible for `robot` and not in `read_as`, and other base::InputError as readMeasuredTable() and
/// readRavenMotors().
MeasuredTable readTable(const std::filesystem::path& path, const robot::Description& robot,
                        const ReadAs& read_as = {});

}  // namespace capstan::recording
