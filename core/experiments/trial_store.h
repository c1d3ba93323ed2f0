#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace capstan::experiments {

/// Store of finished trials, so that an interrupted experiment can continue. Each trial has a file with its
/// full fingerprint (all inputs), a checksum of the result, and the result. Files are written atomically.
class TrialStore {
 public:
  /// `folder` is created at the first write; empty: nothing is stored.
  explicit TrialStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns the stored result of `name`, or nothing. `notice` gets a text when the file is damaged or has
  /// another fingerprint; it names the parts that differ.
  std::optional<nlohmann::json> find(const std::string& name, const nlohmann::json& fingerprint,
                                     std::string& notice) const;
  /// Stores a result. Throws base::InputError when the file cannot be written.
  void keep(const std::string& name, const nlohmann::json& fingerprint, const nlohmann::json& result) const;

  std::filesystem::path fileOf(const std::string& name) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace capstan::experiments
