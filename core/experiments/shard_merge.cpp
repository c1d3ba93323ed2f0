#include "core/experiments/shard_merge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/trial_store.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;

/// One record and its folder.
struct Part {
  fs::path folder;
  ShardRecord record;

  fs::path file() const { return recordFile(folder); }
  std::string again() const {
    return fmt::format("Run: {}", commandLineOf(record, record.shard, folder.string()));
  }
};

/// Checks that `part` belongs to the command of `first`.
void checkSame(const Part& part, const Part& first) {
  const ShardRecord &one = part.record, &other = first.record;
  if (one.command != other.command)
    refuseShard(part.file(),
                fmt::format("is of `{}`, and {} is of `{}`", shellText(one.command), first.file().string(),
                            shellText(other.command)),
                "Merge the shards of one command");
  if (one.shard.count != other.shard.count)
    refuseShard(part.file(),
                fmt::format("is one of {} shards, and {} is one of {}", one.shard.count,
                            first.file().string(), other.shard.count),
                "Merge the shards of one sharding");
  if (one.software != other.software)
    refuseShard(
        part.file(),
        fmt::format("was computed by {}, and {} by {}", one.software, first.file().string(), other.software),
        "Compute all shards with one version");
  if (one.processor != other.processor)
    refuseShard(
        part.file(),
        fmt::format("was computed with {} instructions, and {} with {}: the last bits of the results would "
                    "depend on the sharding",
                    one.processor, first.file().string(), other.processor),
        "Compute all shards on processors of one kind, or with CAPSTAN_INSTRUCTION_SET=baseline");
}

/// Checks that the finished `part` has the trials that its number gives it.
void checkLists(const Part& part, const Part& first) {
  const auto listed = [](const Part& of) {
    std::vector<std::tuple<std::string, std::size_t, std::string>> lists;
    for (const TrialList& list : of.record.lists)
      if (!list.shared) lists.emplace_back(list.folder, list.count, list.checksum);
    return lists;
  };
  if (listed(part) != listed(first))
    refuseShard(part.file(), fmt::format("lists other trials than {}", first.file().string()),
                "Compute all shards with the same input files");
  const Shard& shard = part.record.shard;
  std::size_t own = 0;
  for (std::size_t k = 0; k < part.record.trials(); ++k) own += shard.owns(k) ? 1 : 0;
  if (own != part.record.own())
    refuseShard(part.file(), fmt::format("lists {} of its {} trials", part.record.own(), own), part.again());
}

/// Checks the numbers of sorted parts: each of 1 … count once.
void checkNumbers(const std::vector<Part>& parts) {
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (parts[i].record.shard == parts[i - 1].record.shard)
      refuseShard(parts[i].file(),
                  fmt::format("is shard {}, and so is {}", nameOf(parts[i].record.shard),
                              parts[i - 1].file().string()),
                  "Give each shard once");
  std::vector<std::size_t> missing(parts.front().record.shard.count), there;
  if (missing.size() == parts.size()) return;
  std::iota(missing.begin(), missing.end(), std::size_t{1});
  for (const Part& part : parts) there.push_back(part.record.shard.index);
  std::erase_if(missing, [&](std::size_t i) { return std::binary_search(there.begin(), there.end(), i); });
  constexpr std::size_t kNamed = 10;
  const std::vector<std::size_t> named(missing.begin(), missing.begin() + std::min(kNamed, missing.size()));
  const ShardRecord& record = parts.front().record;
  refuseShard("merge",
              fmt::format("{} of {} shards {} missing: {}{}", missing.size(), record.shard.count,
                          missing.size() == 1 ? "is" : "are", fmt::join(named, ", "),
                          missing.size() > kNamed ? " …" : ""),
              fmt::format("Give all shards. A shard is computed by: {}",
                          commandLineOf(record, {missing.front(), record.shard.count}, "FOLDER")));
}

/// Reads a trial of a shard. A damaged one is refused with the command that computes it again.
StoredTrial readTrial(const fs::path& file, const std::string& again) {
  try {
    return readStoredTrial(file);
  } catch (const base::InputError& error) {
    refuseShard(file, error.fault().reason, again);
  }
}

/// Result without its computing times, which differ from run to run.
nlohmann::json withoutTimes(nlohmann::json result) {
  if (result.is_object()) result.erase("seconds");
  return result;
}

}  // namespace

ShardSet readShards(const std::vector<fs::path>& folders, const std::string& software) {
  std::vector<Part> parts;
  for (const fs::path& folder : folders) parts.push_back({folder, readRecord(folder)});
  if (parts.empty()) throw base::InputError({{}, 0, "merge", {}, "has no shards", "Give their folders"});
  for (const Part& part : parts) checkSame(part, parts.front());
  if (parts.front().record.software != software)
    refuseShard(parts.front().file(),
                fmt::format("was computed by {}, and this is {}", parts.front().record.software, software),
                "Merge with the program that computed the shards, or compute them again");
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.record.shard.index < b.record.shard.index; });
  checkNumbers(parts);
  for (const Part& part : parts)
    if (!part.record.finished)
      refuseShard(part.file(), fmt::format("shard {} is not finished", nameOf(part.record.shard)),
                  part.again());
  for (const Part& part : parts) checkLists(part, parts.front());
  ShardSet shards;
  for (Part& part : parts) {
    shards.folders.push_back(std::move(part.folder));
    shards.records.push_back(std::move(part.record));
  }
  return shards;
}

std::vector<double> collectTrials(const ShardSet& shards, const fs::path& out) {
  std::vector<double> seconds;
  std::map<fs::path, fs::path> common;  // results that several shards may have: target, source
  for (std::size_t i = 0; i < shards.records.size(); ++i)
    for (const TrialList& list : shards.records[i].lists) {
      const TrialStore from(shards.folders[i] / list.folder), to(out / list.folder);
      fs::create_directories(to.folder());
      const std::string again =
          "Run: " + commandLineOf(shards.records[i], shards.records[i].shard, shards.folders[i].string());
      for (const std::string& name : list.own) {
        const fs::path source = from.fileOf(name);
        if (!fs::exists(source))
          refuseShard(source, "does not exist: a trial of shard " + nameOf(shards.records[i].shard), again);
        const StoredTrial trial = readTrial(source, again);
        if (!list.shared) seconds.push_back(trial.seconds);
        const auto [before, first] = common.emplace(to.fileOf(name), source);
        if (first) {
          base::writeTextFile(to.fileOf(name), trial.text);
          continue;
        }
        const StoredTrial other = readStoredTrial(before->second);
        if (trial.fingerprint != other.fingerprint ||
            withoutTimes(trial.result) != withoutTimes(other.result))
          refuseShard(source, fmt::format("has another result than {}", before->second.string()),
                      "Compute all shards with the same input files, on processors of one kind");
      }
    }
  return seconds;
}

}  // namespace capstan::experiments
