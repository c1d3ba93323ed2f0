#pragma once

#include "app/cli/command.h"

namespace capstan::cli {

/// `capstan-cli study one-camera`: one blocked camera, hard switch and ray on the same samples.
void addOneCameraStudy(CLI::App& study, ExitCode& exit);

}  // namespace capstan::cli
