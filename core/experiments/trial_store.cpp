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
                                               std::string& notice) const {
  std::error_code ignored;
  const auto file = fileOf(name);
  if (folder_.empty() || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    nlohmann::json document = nlohmann::json::parse(base::readTextFile(file));
    if (const nlohmann::json& of = document.at("fingerprint"); of != fingerprint) {
      notice = fmt::format("{}: was made from something else ({}); this trial is run again", file.string(),
                           differencesOf(of, fingerprint));
      return std::nullopt;
    }
    nlohmann::json result = std::move(document.at("result"));
    if (document.at("checksum") == base::checksumOf(result.dump())) return result;
    notice = fmt::format("{}: is damaged (wrong checksum); this trial is run again", file.string());
  } catch (const nlohmann::json::exception& error) {
    notice = fmt::format("{}: is damaged ({}); this trial is run again", file.string(), error.what());
  } catch (const base::InputError& error) {
    notice = fmt::format("{}; this trial is run again", error.what());
  }
  return std::nullopt;
}

void TrialStore::keep(const std::string& name, const nlohmann::json& fingerprint,
                      const nlohmann::json& result) const {
  if (folder_.empty()) return;
  std::filesystem::create_directories(folder_);
  const nlohmann::json document = {
      {"fingerprint", fingerprint}, {"checksum", base::checksumOf(result.dump())}, {"result", result}};
  base::writeTextFile(fileOf(name), document.dump() + "\n");
}

}  // namespace capstan::experiments
