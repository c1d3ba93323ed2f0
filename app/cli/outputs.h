#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/simulation/simulation_request.h"

namespace capstan::cli {

/// A file that a command is asked to write: the option (or argument) and its value; empty: not requested.
struct OutputFile {
  std::string option;
  std::string path;
};

/// To be called before anything is computed or written. Throws base::InputError where an output is the same
/// file as one of `inputs` or as another output, is "-" (which only --json may be), or cannot be written.
/// Inputs that are empty or name no file do not count.
void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs);
/// The same for the folder `path`, which need not exist yet, and the `names` written into it.
void checkOutputFolder(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string>& names, const std::vector<std::string>& inputs);

/// `inputs` and the files that a simulation reads.
std::vector<std::string> withFilesOf(const simulation::SimulationRequest& request,
                                     std::vector<std::string> inputs);

}  // namespace capstan::cli
