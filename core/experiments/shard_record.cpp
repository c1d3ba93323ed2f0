#include "core/experiments/shard_record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::experiments {
namespace {

using nlohmann::json;

constexpr int kFormat = 1;
constexpr const char* kFormatKey = "capstan_shard";

json jsonOf(const ShardRecord& record) {
  json lists = json::array();
  for (const TrialList& list : record.lists)
    lists.push_back({{"folder", list.folder},
                     {"trials", list.count},
                     {"names", list.checksum},
                     {"own", list.own},
                     {"shared", list.shared}});
  return {{"command", record.command},
          {"software", record.software},
          {"processor", record.processor},
          {"shard", record.shard.index},
          {"of", record.shard.count},
          {"finished", record.finished},
          {"lists", lists},
          {kFormatKey, kFormat}};
}

ShardRecord recordOf(const json& document) {
  ShardRecord record;
  document.at("command").get_to(record.command);
  document.at("software").get_to(record.software);
  document.at("processor").get_to(record.processor);
  document.at("shard").get_to(record.shard.index);
  document.at("of").get_to(record.shard.count);
  document.at("finished").get_to(record.finished);
  for (const json& one : document.at("lists"))
    record.lists.push_back({.folder = one.at("folder").get<std::string>(),
                            .count = one.at("trials").get<std::size_t>(),
                            .checksum = one.at("names").get<std::string>(),
                            .own = one.at("own").get<std::vector<std::string>>(),
                            .shared = one.at("shared").get<bool>()});
  return record;
}

}  // namespace

std::size_t ShardRecord::trials() const {
  std::size_t sum = 0;
  for (const TrialList& list : lists) sum += list.shared ? 0 : list.count;
  return sum;
}

std::size_t ShardRecord::own() const {
  std::size_t sum = 0;
  for (const TrialList& list : lists) sum += list.shared ? 0 : list.own.size();
  return sum;
}

std::filesystem::path recordFile(const std::filesystem::path& folder) { return folder / "shard.json"; }

ShardRecord readRecord(const std::filesystem::path& folder) {
  const std::filesystem::path file = recordFile(folder);
  if (!std::filesystem::exists(file))
    refuseShard(folder, "is no folder of a shard: it has no shard.json",
                "Give folders that a command with --shard wrote");
  const std::string damaged = "Run the command of this shard again into a new folder";
  try {
    json document = json::parse(base::readTextFile(file));
    if (!document.contains(kFormatKey)) refuseShard(file, "is no record of a shard", damaged);
    if (document.at(kFormatKey) != kFormat)
      refuseShard(file, "is of another version of this program",
                  "Use the program that wrote it, or run its command again");
    const std::string checksum = document.at("checksum").get<std::string>();
    document.erase("checksum");
    if (base::checksumOf(document.dump()) != checksum)
      refuseShard(file, "is damaged (wrong checksum)", damaged);
    return recordOf(document);
  } catch (const json::exception& error) {
    refuseShard(file, fmt::format("is damaged ({})", error.what()), damaged);
  }
}

void writeRecord(const ShardRecord& record, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  json document = jsonOf(record);
  document["checksum"] = base::checksumOf(document.dump());
  base::writeTextFile(recordFile(folder), document.dump(1) + "\n");
}

void checkRecord(const ShardRecord& record, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(recordFile(folder))) return;
  const ShardRecord there = readRecord(folder);
  if (there.command == record.command && there.shard == record.shard) return;
  refuseShard(
      recordFile(folder),
      fmt::format("is of shard {} of `capstan-cli {}`", nameOf(there.shard), shellText(there.command)),
      "Give another folder with --out: each shard has its own");
}

void refuseShard(const std::filesystem::path& file, const std::string& reason, const std::string& remedy) {
  throw base::InputError({file.string(), 0, {}, {}, reason, remedy});
}

std::string shellText(const std::vector<std::string>& words) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,:=@%+";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

std::string commandLineOf(const ShardRecord& record, const Shard& shard, const std::string& folder) {
  return fmt::format("capstan-cli {} --shard {} --out {}", shellText(record.command), nameOf(shard),
                     shellText({folder}));
}

}  // namespace capstan::experiments
