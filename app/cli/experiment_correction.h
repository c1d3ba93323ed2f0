#pragma once

#include <string>

#include "app/cli/command.h"
#include "core/experiments/correction_experiment.h"

namespace capstan::cli {

/// Arguments of experiments E to H, in addition to those of all experiments.
struct CorrectionExperimentArguments {
  std::string towards = "command";
  experiments::CorrectionExperimentOptions options;
};

/// Declares the options of experiments E to H on `command`.
void addCorrectionOptions(CLI::App& command, CorrectionExperimentArguments& arguments);

/// Returns whether `name` is one of E to H.
bool isCorrectionExperiment(const std::string& name);

/// Runs experiment `name` and writes comparison.md, numbers.json, tables and figures into `out`/`name`.
ExitCode runCorrectionExperiment(const std::string& name, const std::string& out, const std::string& json,
                                 int threads, CorrectionExperimentArguments& arguments);

}  // namespace capstan::cli
