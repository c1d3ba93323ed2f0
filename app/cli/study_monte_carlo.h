#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study worlds`: are the parameters that identification states those of a hundred robots?
void addMonteCarloStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
