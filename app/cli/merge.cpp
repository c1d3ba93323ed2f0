#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/shard_option.h"
#include "core/base/yaml.h"
#include "core/experiments/shard_merge.h"
#include "core/experiments/trial_cost.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::string out, json;
  std::vector<std::string> shards;
};

fs::path mergeRecordFile(const fs::path& out) { return out / "merge.json"; }

nlohmann::json mergeRecordOf(const experiments::ShardSet& shards) {
  return {{"capstan_merge", 1},
          {"command", shards.command()},
          {"software", shards.records.front().software},
          {"processor", shards.records.front().processor}};
}

/// Checks that `out` is new or empty, or that an earlier merge of the same shards wrote it.
void checkMergeFolder(const fs::path& out, const experiments::ShardSet& shards) {
  for (const fs::path& shard : shards.folders)
    if (std::error_code none; fs::equivalent(out, shard, none))
      refuseFile(out.string(), "is the folder of a shard", "Give another folder for the results first");
  if (!fs::exists(out) || (fs::is_directory(out) && fs::is_empty(out))) return;
  const fs::path file = mergeRecordFile(out);
  if (fs::exists(file)) {
    const auto there = nlohmann::json::parse(base::readTextFile(file), nullptr, false);
    const nlohmann::json record = mergeRecordOf(shards);
    if (there.is_object() && there.value("command", nlohmann::json()) == record["command"]) return;
  }
  refuseFile(out.string(), "holds other files", "Give a new or empty folder for the results first");
}

/// Removes a folder that did not exist, unless the work in it was completed.
class NewFolder {
 public:
  explicit NewFolder(fs::path folder) : folder_(std::move(folder)), existed_(fs::exists(folder_)) {}
  ~NewFolder() {
    std::error_code ignored;
    if (!existed_ && !done_) fs::remove_all(folder_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  void done() { done_ = true; }

 private:
  fs::path folder_;
  bool existed_, done_ = false;
};

/// Runs the command of the shards on their stored trials.
ExitCode replayed(const experiments::ShardSet& shards, const MergeArguments& arguments) {
  std::vector<std::string> words = shards.command();
  words.insert(words.end(), {"--out", arguments.out, "--stored-only"});
  if (!arguments.json.empty()) words.insert(words.end(), {"--json", arguments.json});
  ExitCode exit = kOk;
  CLI::App app;
  app.require_subcommand(1);
  addExperiment(app, exit);
  addStudy(app, exit);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    refuseFile(experiments::recordFile(shards.folders.front()).string(),
               fmt::format("has a command that is refused ({})", error.what()),
               "Start merge in the folder in which the shards were computed");
  }
  return exit;
}

ExitCode merge(const MergeArguments& arguments) {
  const experiments::ShardSet shards =
      experiments::readShards({arguments.shards.begin(), arguments.shards.end()}, programOfShards());
  checkOutputFolder("OUT", arguments.out, {}, {});
  checkOutputs({{"--json", arguments.json}}, {});
  checkMergeFolder(arguments.out, shards);
  NewFolder folder(arguments.out);
  fs::create_directories(arguments.out);
  base::writeTextFile(mergeRecordFile(arguments.out), mergeRecordOf(shards).dump(1) + "\n");
  const experiments::TrialCost cost = experiments::costOf(experiments::collectTrials(shards, arguments.out));
  const ExitCode exit = replayed(shards, arguments);
  if (exit != kOk) return exit;
  const std::string table = base::markdownOf(experiments::costTable(cost));
  base::writeTextFile(fs::path(arguments.out) / "cost.md", table);
  base::writeTextFile(fs::path(arguments.out) / "cost.json", experiments::costJson(cost).dump(1) + "\n");
  Output(arguments.json).text("\n" + table);
  folder.done();
  return kOk;
}

}  // namespace

void addMerge(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command =
      app.add_subcommand("merge",
                         "Make the results of an experiment or a study from all of its shards (--shard),\n"
                         "and print the computing time of its trials");
  command->add_option("OUT", arguments->out, "folder for the results: new, empty, or of an earlier merge")
      ->required();
  command->add_option("SHARD", arguments->shards, "folders of all shards, in any order")->required();
  command->add_option("--json", arguments->json,
                      "result of the command as JSON, SI: a file, or - for standard output");
  command->footer(
      "The results are those of the same command without --shard. merge reads the input files of the "
      "command\n"
      "again: start it in the folder in which the shards were computed. cost.json has the seconds per "
      "trial.\n"
      "Example:\n"
      "  capstan-cli study monte-carlo --count 10 --shard 1/2 --out part-1\n"
      "  capstan-cli study monte-carlo --count 10 --shard 2/2 --out part-2\n"
      "  capstan-cli merge samples part-1 part-2");
  command->callback([arguments, &exit] { exit = merge(*arguments); });
}

}  // namespace capstan::cli
