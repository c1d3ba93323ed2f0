#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study monte-carlo`: bias and coverage of identification over randomized robots.
void addMonteCarloStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
