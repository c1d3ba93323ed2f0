#include "app/cli/shard_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/cli/console.h"
#include "core/base/checksum.h"
#include "core/base/software.h"
#include "core/math/instruction_set.h"

namespace capstan::cli {
namespace {

/// Options that no result depends on.
constexpr std::array kOutsideOfResults = {"--threads", "--out",         "--json", "--csv",
                                          "--shard",   "--stored-only", "--help"};

bool countsForResults(const CLI::Option& option) {
  return option.count() > 0 && std::none_of(kOutsideOfResults.begin(), kOutsideOfResults.end(),
                                            [&](const char* name) { return option.check_name(name); });
}

void addWords(const CLI::Option& option, std::vector<std::string>& words) {
  if (!option.get_lnames().empty()) words.push_back("--" + option.get_lnames().front());
  if (option.get_items_expected_max() == 0) return;  // a flag
  const std::vector<std::string> values = option.results();
  words.insert(words.end(), values.begin(), values.end());
}

experiments::ShardRecord recordOf(const ShardArguments& arguments, const experiments::Shard& shard) {
  return {.command = commandWords(*arguments.command),
          .software = programOfShards(),
          .processor = math::nameOf(math::bestInstructionSet()),
          .shard = shard,
          .finished = false,
          .lists = {}};
}

/// Writes the unfinished record, unless there is one of the same program, which may be finished.
void beginRecord(const experiments::ShardRecord& record, const std::string& out) {
  experiments::checkRecord(record, out);
  if (std::filesystem::exists(experiments::recordFile(out))) {
    const experiments::ShardRecord there = experiments::readRecord(out);
    if (there.software == record.software && there.processor == record.processor) return;
  }
  experiments::writeRecord(record, out);
}

}  // namespace

void addShardOption(CLI::App& command, ShardArguments& arguments, const std::string& trials) {
  arguments.command = &command;
  CLI::Option* shard = command.add_option("--shard", arguments.shard,
                                          "run only part i of n of the " + trials +
                                              " (i/n, for example 2/8), into a folder of its own (--out);\n"
                                              "`capstan-cli merge` makes the results of all parts");
  command
      .add_flag("--stored-only", arguments.stored_only,
                "only write the results of the trials that are stored in --out; nothing is computed")
      ->excludes(shard);
}

void refuseShardOption(CLI::App& command, const std::string& reason) {
  command
      .add_option_function<std::string>(
          "--shard",
          [reason](const std::string& value) {
            refuseOption("--shard", value, reason, "Run it without --shard; --threads uses more cores");
          },
          reason)
      ->group("")
      ->trigger_on_parse();
}

std::vector<std::string> commandWords(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* app = &command; app->get_parent() != nullptr; app = app->get_parent())
    words.insert(words.begin(), app->get_name());
  for (const bool positional : {true, false})
    for (const CLI::Option* option : command.get_options())
      if (countsForResults(*option) && option->get_lnames().empty() == positional) addWords(*option, words);
  return words;
}

std::string programOfShards() {
  const std::string software = base::software();
  const bool exact = software.find('(') != std::string::npos && software.find("dirty") == std::string::npos;
  return exact ? software : software + " " + base::checksumOfFile("/proc/self/exe");
}

ShardRun::ShardRun(const ShardArguments& arguments, const std::string& out,
                   const std::vector<std::pair<std::string, std::string>>& others)
    : out_(out) {
  if (arguments.shard.empty() && !arguments.stored_only) return;
  if (out.empty() || arguments.command->count("--out") == 0)
    refuseOption(arguments.stored_only ? "--stored-only" : "--shard", arguments.shard,
                 "needs a folder of its own", "Name it with --out");
  part_.emplace();
  part_->out = out;
  if (arguments.stored_only) {
    part_->kind = experiments::PartialRun::Kind::kStoredOnly;
    return;
  }
  part_->shard = experiments::parseShard(arguments.shard);
  for (const auto& [option, path] : others)
    if (!path.empty())
      refuseOption(option, path, "is not written by a shard, which has no results",
                   "Give it to `capstan-cli merge`, or use the files in its folder");
  record_ = recordOf(arguments, part_->shard);
  beginRecord(record_, out);
}

std::string ShardRun::finish() {
  record_.finished = true;
  record_.lists = part_->lists;
  experiments::writeRecord(record_, out_);
  return fmt::format("shard {}: {} of {} trials in {}\n", experiments::nameOf(record_.shard), record_.own(),
                     record_.trials(), out_);
}

}  // namespace capstan::cli
