#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study filter`: errors of the six-state and the augmented filter on the same samples.
void addFilterStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
