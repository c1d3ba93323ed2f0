#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command.h"

/// `capstan-cli study NAME`: Monte-Carlo questions about the method rather than about a recording. A study a
/// file, study_*.cpp; it adds its own subcommand to `study`, and addStudy() calls it by one line.
namespace capstan::cli {}
