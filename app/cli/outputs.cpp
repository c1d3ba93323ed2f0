#include "app/cli/outputs.h"

#include <fmt/format.h>

#include "app/cli/console.h"
#include "core/base/error.h"
#include "core/base/part_file.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;

/// Returns whether both paths name one regular file. Devices and pipes may be given twice: they lose no data.
bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code fault;
  if (fs::exists(a, fault) && !fs::is_regular_file(a, fault)) return false;
  if (fs::equivalent(a, b, fault)) return true;
  return fs::weakly_canonical(fs::absolute(a, fault), fault) ==
         fs::weakly_canonical(fs::absolute(b, fault), fault);
}

void refuseInput(const OutputFile& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (!input.empty() && sameFile(output.path, input))
      refuseOption(output.option, output.path, "is the same file as the input " + input, "Give another name");
}

}  // namespace

void checkOutputs(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (output.path.empty()) continue;
    if (output.path == "-") {
      if (output.option == "--json") continue;
      refuseOption(output.option, "-", "only --json writes to standard output", "Give a file name");
    }
    refuseInput(output, inputs);
    for (std::size_t other = 0; other < i; ++other)
      if (!outputs[other].path.empty() && sameFile(output.path, outputs[other].path))
        refuseOption(output.option, output.path, "is the file of " + outputs[other].option + " too",
                     "Give them two names");
    base::checkWritable(output.path);
  }
}

void checkOutputFolder(const std::string& option, const fs::path& path, const std::vector<std::string>& names,
                       const std::vector<std::string>& inputs) {
  if (path == "-") refuseOption(option, "-", "only --json writes to standard output", "Give a folder");
  for (const std::string& name : names) refuseInput({option, (path / name).string()}, inputs);
  std::error_code fault;
  fs::path there = fs::absolute(path, fault).lexically_normal();
  while (!fs::exists(there, fault) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, fault))
    refuseOption(option, path.string(),
                 there == fs::absolute(path, fault) ? "is no folder"
                                                    : "cannot be made: " + there.string() + " is no folder",
                 "Give a folder that exists or can be made");
  try {
    base::checkWritable(there / "capstan");
  } catch (const base::InputError& error) {
    refuseOption(option, path.string(), error.fault().reason, "Give a folder that files can be written into");
  }
}

void refuseExisting(const std::string& option, const fs::path& path) {
  if (fs::exists(path))
    refuseFile(path.string(), "exists already",
               fmt::format("Give another {}, or add --force to overwrite it", option));
}

std::vector<std::string> withFilesOf(const simulation::SimulationRequest& request,
                                     std::vector<std::string> inputs) {
  for (const fs::path& file :
       {fs::path(request.trajectory), fs::path(request.truth), fs::path(request.robot)})
    inputs.push_back(file.string());
  if (!request.cameras.empty())
    for (const char* name : {"left.yaml", "right.yaml"})
      inputs.push_back((fs::path(request.cameras) / name).string());
  inputs.push_back(request.cameras.string());
  return inputs;
}

}  // namespace capstan::cli
