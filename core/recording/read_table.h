#pragma once

#include <filesystem>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// Is `path` a session file, by its suffix or its first bytes? Throws base::InputError where it cannot be
/// opened.
bool isSession(const std::filesystem::path& path);

/// The measured table, or recording of the RAVEN-II's own software, at `path`, in SI units: what everybody
/// reads tables with. Columns of a measured table are read as `read_as` says; the header of the RAVEN-II's
/// states its units. Throws ImplausibleUnits for columns that `robot` can hardly have measured and `read_as`
/// says nothing of, other base::InputError as readMeasuredTable() and readRavenMotors().
MeasuredTable readTable(const std::filesystem::path& path, const robot::Description& robot,
                        const ReadAs& read_as = {});

}  // namespace capstan::recording
