#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/base/progress.h"

namespace capstan::cli {

/// Line of progress on standard error, shown on a terminal only and for the lifetime of the object. Ctrl-C
/// and SIGTERM cancel `progress`.
class ProgressLine {
 public:
  explicit ProgressLine(base::Progress& progress);
  ~ProgressLine();

 private:
  void (*interrupt_)(int);  ///< former handler of SIGINT
  void (*terminate_)(int);  ///< former handler of SIGTERM
  std::jthread thread_;
};

/// Version of the JSON documents that the manual describes (resources/manual/json.md). It rises when a key is
/// renamed or removed, or its meaning changes; not when one is added.
inline constexpr int kJsonSchema = 1;

/// Outputs of a command. The target of --json is empty (none), "-" (standard output) or a file.
class Output {
 public:
  explicit Output(std::string json_target) : json_target_(std::move(json_target)) {}
  /// Prints text for people on standard output; prints nothing if --json writes there.
  void text(const std::string& text) const;
  /// Writes one JSON document to the target of --json: numbers to the last bit, NaN as null. An object also
  /// gets the key "schema" with kJsonSchema. Throws base::InputError when the file cannot be written.
  void json(const nlohmann::json& document) const;

 private:
  std::string json_target_;
};

/// Throws base::InputError about a file, or about an option or argument.
[[noreturn]] void refuseFile(const std::string& file, const std::string& reason, const std::string& remedy);
[[noreturn]] void refuseOption(const std::string& name, const std::string& value, const std::string& reason,
                               const std::string& remedy);

/// Prints a notice for people on standard error.
void notice(const std::string& text);

nlohmann::json toJson(const Eigen::Vector3d& vector);
/// `position` [m] and `quaternion` (x, y, z, w).
nlohmann::json toJson(const Eigen::Isometry3d& pose);

/// Present local time as ISO 8601, to the second.
std::string isoNow();
/// Seconds since 1970 of such a text; 0 for another text.
int secondsOfIso(const std::string& text);

}  // namespace capstan::cli
