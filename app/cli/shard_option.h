#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/experiments/shard_record.h"

/// --shard i/n of commands that run lists of independent trials.
namespace capstan::cli {

struct ShardArguments {
  std::string shard;                  ///< --shard: "i/n"; empty: all trials
  bool stored_only = false;           ///< --stored-only: results of stored trials, for `merge`
  const CLI::App* command = nullptr;  ///< the command that the options belong to
};

/// Declares --shard and the hidden --stored-only. `trials`: noun in the help, e.g. "samples".
void addShardOption(CLI::App& command, ShardArguments& arguments, const std::string& trials);
/// Declares a hidden --shard of a command without independent trials. Its use is refused with `reason`.
void refuseShardOption(CLI::App& command, const std::string& reason);

/// Words of the parsed command line without those that no result depends on: --threads, --out, --json,
/// --shard.
std::vector<std::string> commandWords(const CLI::App& command);

/// Program and version; of a build that no commit stands for also the checksum of its file.
std::string programOfShards();

/// One run of a command with `arguments`: of all trials, of a shard, or of stored trials.
class ShardRun {
 public:
  /// Of a shard, checks the options and writes an unfinished record into `out`. `others`: outputs that a
  /// shard does not have (option, path). Throws base::InputError for options that do not go together and for
  /// a folder of another shard.
  ShardRun(const ShardArguments& arguments, const std::string& out,
           const std::vector<std::pair<std::string, std::string>>& others);

  /// Trials to run; null: all.
  experiments::PartialRun* part() { return part_ ? &*part_ : nullptr; }
  bool isShard() const { return part_ && part_->isShard(); }
  /// Writes the record of the finished shard. Returns a sentence for people.
  std::string finish();

 private:
  std::string out_;
  std::optional<experiments::PartialRun> part_;
  experiments::ShardRecord record_;
};

}  // namespace capstan::cli
