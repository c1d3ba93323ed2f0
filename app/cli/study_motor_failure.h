#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `study motor-failure`.
void addMotorFailureStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
