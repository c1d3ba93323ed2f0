#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/experiments/shard.h"

namespace capstan::experiments {

/// What a folder of a shard is: the file shard.json in it. It is written before the first trial, and again
/// when all trials are finished.
struct ShardRecord {
  std::vector<std::string> command;  ///< words of the command line without --shard, --out, --threads
  std::string software;              ///< program and version
  std::string processor;             ///< instruction set of the hot kernels: the last bits depend on it
  Shard shard;
  bool finished = false;         ///< true: all trials of the shard are stored
  std::vector<TrialList> lists;  ///< empty while not finished

  std::size_t trials() const;  ///< number of trials of the whole command
  std::size_t own() const;     ///< number of trials of the shard
};

/// Path of the record in `folder`.
std::filesystem::path recordFile(const std::filesystem::path& folder);
/// Reads the record of `folder`. Throws base::InputError when there is none, when it is damaged, or when it
/// is of another format.
ShardRecord readRecord(const std::filesystem::path& folder);
/// Writes the record, atomically. Throws base::InputError when it cannot be written.
void writeRecord(const ShardRecord& record, const std::filesystem::path& folder);

/// Checks that `folder` may become that of `record`: it has no record, or one of the same command and shard.
/// Throws base::InputError otherwise.
void checkRecord(const ShardRecord& record, const std::filesystem::path& folder);

/// Throws base::InputError about a file of a shard.
[[noreturn]] void refuseShard(const std::filesystem::path& file, const std::string& reason,
                              const std::string& remedy);

/// Command line that computes the shard into `folder`, for a shell.
std::string commandLineOf(const ShardRecord& record, const Shard& shard, const std::string& folder);
/// Words as a shell reads them, quoted where needed.
std::string shellText(const std::vector<std::string>& words);

}  // namespace capstan::experiments
