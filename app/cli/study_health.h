#pragma once

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study health`: verdicts of the health checks on sessions with one known fault.
void addHealthStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
