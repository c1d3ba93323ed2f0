#include "core/experiments/trial_store.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/results.h"

namespace capstan::experiments {
namespace {

/// Keys whose values differ, or that only one of the two has; each once.
std::string differencesOf(const nlohmann::json& kept, const nlohmann::json& wanted) {
  std::vector<std::string> names;
  for (const auto& [key, value] : wanted.items())
    if (!kept.contains(key) || kept.at(key) != value) names.push_back(key);
  for (const auto& [key, value] : kept.items())
    if (!wanted.contains(key)) names.push_back(key);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::filesystem::path TrialStore::fileOf(const std::string& name) const {
  return folder_ / (fileNameOf(name) + ".json");
}

std::optional<nlohmann::json> TrialStore::find(const std::string& name, const nlohmann::json& fingerprint,
                                               std::string& reason) const {
  std::error_code ignored;
  const auto file = fileOf(name);
  if (folder_.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    StoredTrial stored = readStoredTrial(file);
    if (stored.fingerprint == fingerprint) return std::move(stored.result);
    reason = fmt::format("was made from something else ({})", differencesOf(stored.fingerprint, fingerprint));
  } catch (const base::InputError& error) {
    reason = error.fault().reason;
  }
  return std::nullopt;
}

StoredTrial readStoredTrial(const std::filesystem::path& file) {
  std::string damage = "wrong checksum";
  StoredTrial stored;
  stored.text = base::readTextFile(file);
  try {
    nlohmann::json document = nlohmann::json::parse(stored.text);
    stored.fingerprint = std::move(document.at("fingerprint"));
    stored.result = std::move(document.at("result"));
    const auto seconds = document.find("seconds");
    stored.seconds = seconds == document.end() ? kNone : seconds->get<double>();
    if (document.at("checksum") == base::checksumOf(stored.result.dump())) return stored;
  } catch (const nlohmann::json::exception& error) {
    damage = error.what();
  }
  throw base::InputError({file.string(),
                          0,
                          {},
                          {},
                          fmt::format("is damaged ({})", damage),
                          "Remove this file: the command that wrote it computes it again"});
}

void TrialStore::keep(const std::string& name, const nlohmann::json& fingerprint,
                      const nlohmann::json& result, double seconds) const {
  if (folder_.empty()) return;
  std::filesystem::create_directories(folder_);
  const nlohmann::json document = {{"fingerprint", fingerprint},
                                   {"checksum", base::checksumOf(result.dump())},
                                   {"result", result},
                                   {"seconds", seconds}};
  base::writeTextFile(fileOf(name), document.dump() + "\n");
}

}  // namespace capstan::experiments
