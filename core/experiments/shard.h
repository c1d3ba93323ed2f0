#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace capstan::experiments {

/// Part `index` of `count` of a list of independent trials. The seed of a trial depends on its place in the
/// whole list only, so that its result is the same in every sharding.
struct Shard {
  std::size_t index = 1;  ///< 1 … count, as the task numbers of a job array
  std::size_t count = 1;

  /// Trial k, counted from 0, belongs to shard k mod count + 1: shards differ by one trial at most.
  bool owns(std::size_t trial) const { return trial % count + 1 == index; }
  bool operator==(const Shard&) const = default;
};

/// Returns the text "i/n".
std::string nameOf(const Shard& shard);
/// Reads "i/n" with 1 ≤ i ≤ n ≤ 1 000 000. Throws base::InputError for another text.
Shard parseShard(const std::string& text);

/// Trials of one list of a command, and those of them that a shard has.
struct TrialList {
  std::string folder;            ///< folder of the stored trials, relative to that of the results
  std::size_t count = 0;         ///< number of trials of the whole list
  std::string checksum;          ///< base::checksumOf() the names of the whole list
  std::vector<std::string> own;  ///< names of the shard's trials
  /// True for what every shard computes because its trials need it: the identification before experiment C.
  bool shared = false;
};

/// Which trials of a command are computed, if not all. The function that runs them fills `lists`.
struct PartialRun {
  enum class Kind {
    kShard,      ///< the trials of `shard`; no results are made of them
    kStoredOnly  ///< none: results are made of stored trials, and a trial that is not stored is an error
  };
  Kind kind = Kind::kShard;
  Shard shard;
  std::filesystem::path out = {};  ///< folder of the results
  std::vector<TrialList> lists = {};
  std::size_t trials = 0;  ///< number of trials in `lists` that are not shared

  bool isShard() const { return kind == Kind::kShard; }
  /// Whether trial `k` of the next list is computed or read.
  bool includes(std::size_t k) const { return !isShard() || shard.owns(trials + k); }
  /// Adds a list of trials that are stored in `folder`; trial k of it is trial `trials` + k of the command.
  void add(const std::filesystem::path& folder, const std::vector<std::string>& names);
  /// Adds one result that every shard computes.
  void addShared(const std::filesystem::path& folder, const std::string& name);
};

/// Whether trial `k` of the next list is computed or read; `part` null: all trials.
inline bool includes(const PartialRun* part, std::size_t k) { return part == nullptr || part->includes(k); }

/// Throws base::InputError about the stored trial `file` of a run of kind kStoredOnly; `reason` empty: it
/// does not exist.
[[noreturn]] void refuseStored(const std::filesystem::path& file, const std::string& reason);

}  // namespace capstan::experiments
