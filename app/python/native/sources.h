#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/python/native/table_input.h"
#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::python {

/// Units that a caller states, "q_m=deg,p_c=mm". Throws base::InputError named `read_as`.
recording::ReadAs readAsOf(const std::string& text);

/// Measured table in SI units. Throws as cli::readTable().
recording::MeasuredTable readTable(const TableInput& table, const robot::Description& robot,
                                   const recording::ReadAs& read_as);

/// Any recording as a source, as the command line opens it. `robot` is the path of a robot file for
/// recordings without a robot; empty: the default robot.
std::unique_ptr<tracking::Source> openSource(const TableInput& recording, const std::string& robot,
                                             const recording::ReadAs& read_as,
                                             const std::string& topics = {});

/// Whether the recording is a session, which contains its robot.
bool isSession(const TableInput& recording);

}  // namespace capstan::python
