#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace capstan::experiments {

/// Store of finished trials, so that an interrupted experiment can continue. Each trial has a file with its
/// full fingerprint (all inputs), a checksum of the result, the result, and the elapsed time. Files are
/// written atomically.
class TrialStore {
 public:
  /// `folder` is created at the first write; empty: nothing is stored.
  explicit TrialStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns the stored result of `name`, or nothing. `reason` gets why an existing file is not used: it is
  /// damaged, or has another fingerprint; then it names the parts that differ.
  std::optional<nlohmann::json> find(const std::string& name, const nlohmann::json& fingerprint,
                                     std::string& reason) const;
  /// Stores a result and its elapsed time [s]. Throws base::InputError when the file cannot be written.
  void keep(const std::string& name, const nlohmann::json& fingerprint, const nlohmann::json& result,
            double seconds) const;

  std::filesystem::path fileOf(const std::string& name) const;
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Content of a stored trial's file.
struct StoredTrial {
  std::string text;            ///< text of the file
  nlohmann::json fingerprint;  ///< all inputs
  nlohmann::json result;
  double seconds = 0.0;  ///< elapsed time [s]; NaN where an earlier version stored none
};

/// Reads a stored trial. Throws base::InputError when the file does not exist, cannot be read or is damaged.
StoredTrial readStoredTrial(const std::filesystem::path& file);

}  // namespace capstan::experiments
