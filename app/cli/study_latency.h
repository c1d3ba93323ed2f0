#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `study latency`.
void addLatencyStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
