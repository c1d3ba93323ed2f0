#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study motor-failure`: errors of joints whose motor encoder has failed.
void addMotorFailureStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
