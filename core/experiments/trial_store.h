#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace capstan::experiments {

/// Finished trials, a file each, so that an interrupted experiment goes on where it stopped. A file holds
/// what the trial was made from (its fingerprint, in full), a checksum of the result, and the result; it
/// appears whole or not at all.
class TrialStore {
 public:
  /// `folder`: created at the first write; empty: keeps nothing.
  explicit TrialStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The result kept under `name`; nothing where there is none, and nothing, with a word in `notice`, where
  /// it was made from something else (the parts of the fingerprint that differ are named) or its file is
  /// damaged.
  std::optional<nlohmann::json> find(const std::string& name, const nlohmann::json& fingerprint,
                                     std::string& notice) const;
  /// Throws base::InputError when the file cannot be written.
  void keep(const std::string& name, const nlohmann::json& fingerprint, const nlohmann::json& result) const;

  std::filesystem::path fileOf(const std::string& name) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace capstan::experiments
