#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study latency`: the identified delay of the camera's clock beside its true delay.
void addLatencyStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
