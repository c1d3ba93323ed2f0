#pragma once

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "widgets/figures/export_all.h"

namespace capstan::cli {

/// Prints what an export wrote and what it lacks, and its JSON document. Returns kFailed for a cancelled one.
ExitCode print(const widgets::ExportReport& report, const Output& output);

}  // namespace capstan::cli
