#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study cramer-rao`: the filter's errors beside the posterior Cramér–Rao bound, and its errors
/// with measurement noise from pixels, registration and clock beside those with a constant.
void addCramerRaoStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
