#pragma once

#include <string>

#include "app/cli/command.h"
#include "core/experiments/correction_experiment.h"

namespace capstan::cli {

/// Options of experiments E to H, beside those of all.
struct CorrectionExperimentArguments {
  std::string towards = "command";
  experiments::CorrectionExperimentOptions options;
};

void addCorrectionOptions(CLI::App& command, CorrectionExperimentArguments& arguments);

/// Is `name` one of E to H?
bool isCorrectionExperiment(const std::string& name);

/// Runs experiment `name` and leaves comparison.md, numbers.json, tables and figures in `out`/`name`.
ExitCode runCorrectionExperiment(const std::string& name, const std::string& out, const std::string& json,
                                 int threads, CorrectionExperimentArguments& arguments);

}  // namespace capstan::cli
