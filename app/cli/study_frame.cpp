#include "app/cli/study_frame.h"

#include <filesystem>

#include "core/base/yaml.h"

namespace capstan::cli {

void addStudyOptions(CLI::App& command, StudyArguments& arguments, int& threads, const std::string& trials) {
  command.add_option("--threads", threads, "number of " + trials + " that run in parallel")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command.add_option(
      "--out", arguments.out,
      arguments.keeps ? "folder for the tables and finished " + trials : "folder for the tables");
  if (arguments.keeps) addShardOption(command, arguments.shard, trials);
  command.add_option("--json", arguments.json, "result as JSON, SI: a file, or - for standard output");
}

void checkStudyOutputs(const StudyArguments& arguments, const std::string& name,
                       const std::vector<OutputFile>& more, const std::vector<std::string>& inputs) {
  std::vector<OutputFile> outputs = {{"--json", arguments.json}};
  outputs.insert(outputs.end(), more.begin(), more.end());
  checkOutputs(outputs, inputs);
  if (!arguments.out.empty()) checkOutputFolder("--out", arguments.out, {name + ".md"}, inputs);
}

void writeStudy(const StudyArguments& arguments, const std::string& name, const StudyReport& report) {
  const Output output(arguments.json);
  output.text(report.text);
  output.json(report.json);
  if (arguments.out.empty()) return;
  const std::filesystem::path folder = arguments.out;
  std::filesystem::create_directories(folder);
  base::writeTextFile(folder / (name + ".md"), report.text);
  for (const auto& [file, text] : report.files) base::writeTextFile(folder / file, text);
}

}  // namespace capstan::cli
