#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/simulation/simulation_request.h"

namespace capstan::cli {

/// File that a command writes: the option (or argument) that names it, and its path; empty: not requested.
struct OutputFile {
  std::string option;
  std::string path;
};

/// Checks outputs before anything is computed or written. Throws base::InputError where an output is the same
/// file as one of `inputs` or as another output, is "-" (which only --json may be), or cannot be written.
/// Inputs that are empty or name no file do not count.
void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs);
/// Checks, in the same way, the folder `path`, which need not exist yet, and the files `names` in it.
void checkOutputFolder(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string>& names, const std::vector<std::string>& inputs);

/// Refuses the output file `path`, which `option` names, if it exists. The remedy names --force.
void refuseExisting(const std::string& option, const std::filesystem::path& path);

/// Returns `inputs` and the files that the simulation reads.
std::vector<std::string> withFilesOf(const simulation::SimulationRequest& request,
                                     std::vector<std::string> inputs);

}  // namespace capstan::cli
