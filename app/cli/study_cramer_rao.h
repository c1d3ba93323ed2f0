#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study cramer-rao`: how close is the filter to the best that there can be, and what does
/// measurement noise from its sources bring against a constant?
void addCramerRaoStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
