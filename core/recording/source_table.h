#pragma once

#include <string>

#include "core/recording/measured_table.h"
#include "core/tracking/source.h"

namespace capstan::recording {

/// Measured table of all samples of a source without its images, by the rules of sessionTable(). `file` names
/// it in errors.
MeasuredTable tableOf(tracking::Source& source, const std::string& file);

}  // namespace capstan::recording
