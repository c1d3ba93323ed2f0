#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/experiments/shard_record.h"

namespace capstan::experiments {

/// All shards of one command, in the order of their numbers.
struct ShardSet {
  std::vector<std::filesystem::path> folders;
  std::vector<ShardRecord> records;

  const std::vector<std::string>& command() const { return records.front().command; }
};

/// Reads the records of `folders` and checks that they are, each once, all shards of one command, finished,
/// computed by the program `software`, and on one kind of processor. Trials are not read. Throws
/// base::InputError that names the folder or file and the remedy.
ShardSet readShards(const std::vector<std::filesystem::path>& folders, const std::string& software);

/// Copies the stored trials of all shards into `out`, each file atomically. Returns the elapsed times of the
/// trials that are not shared [s]. Throws base::InputError when a trial is missing or damaged, or when shards
/// have different results of what they share.
std::vector<double> collectTrials(const ShardSet& shards, const std::filesystem::path& out);

}  // namespace capstan::experiments
