#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `study filter`: the six-state filter and the augmented one side by side.
void addFilterStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
