#include "core/experiments/shard.h"

#include <fmt/format.h>

#include <charconv>

#include "core/base/checksum.h"
#include "core/base/error.h"

namespace capstan::experiments {
namespace {

constexpr std::size_t kMaxShards = 1'000'000;

/// Number at the beginning of `text`, which is removed; 0 where there is none.
std::size_t takeNumber(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc()) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

std::string relativeTo(const std::filesystem::path& out, const std::filesystem::path& folder) {
  return folder.lexically_normal().lexically_relative((out / "").lexically_normal()).generic_string();
}

}  // namespace

std::string nameOf(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

Shard parseShard(const std::string& text) {
  std::string_view rest = text;
  Shard shard;
  shard.index = takeNumber(rest);
  const bool divided = rest.substr(0, 1) == "/";
  if (divided) rest.remove_prefix(1);
  shard.count = divided ? takeNumber(rest) : 0;
  if (!rest.empty() || shard.index < 1 || shard.index > shard.count || shard.count > kMaxShards)
    throw base::InputError({{},
                            0,
                            "--shard",
                            text,
                            "is no part of a whole",
                            fmt::format("Give i/n with 1 ≤ i ≤ n ≤ {}, for example 2/8", kMaxShards)});
  return shard;
}

void PartialRun::add(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  TrialList list{
      .folder = relativeTo(out, folder), .count = names.size(), .checksum = {}, .own = {}, .shared = false};
  std::string all;
  for (std::size_t k = 0; k < names.size(); ++k) {
    all += names[k] + '\n';
    if (shard.owns(trials + k)) list.own.push_back(names[k]);
  }
  list.checksum = base::checksumOf(all);
  trials += names.size();
  lists.push_back(std::move(list));
}

void PartialRun::addShared(const std::filesystem::path& folder, const std::string& name) {
  lists.push_back({.folder = relativeTo(out, folder),
                   .count = 1,
                   .checksum = base::checksumOf(name + '\n'),
                   .own = {name},
                   .shared = true});
}

void refuseStored(const std::filesystem::path& file, const std::string& reason) {
  throw base::InputError({file.string(),
                          0,
                          {},
                          {},
                          reason.empty() ? "does not exist" : reason,
                          "Give the options and the unchanged input files of the runs that computed the "
                          "trials, and start in the same folder"});
}

}  // namespace capstan::experiments
