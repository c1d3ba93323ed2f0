#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/base/progress.h"

namespace capstan::cli {

/// Shows `progress` on standard error while it lives, on a terminal only, and cancels it at Ctrl-C and
/// SIGTERM.
class ProgressLine {
 public:
  explicit ProgressLine(base::Progress& progress);
  ~ProgressLine();

 private:
  void (*interrupt_)(int);  ///< what SIGINT did before
  void (*terminate_)(int);  ///< and SIGTERM
  std::jthread thread_;
};

/// Version of the JSON documents that the manual describes (resources/manual/json.md). It rises when a key is
/// renamed or removed, or its meaning changes; not when one is added.
inline constexpr int kJsonSchema = 1;

/// Where --json goes: empty (nowhere), "-" (standard output) or a file.
class Output {
 public:
  explicit Output(std::string json_target) : json_target_(std::move(json_target)) {}
  /// Text for people on standard output; silent where standard output belongs to the JSON.
  void text(const std::string& text) const;
  /// One JSON document, numbers to the last bit, NaN as null. Throws base::InputError when the file cannot be
  /// written.
  /// With "schema": kJsonSchema beside what an object has.
  void json(const nlohmann::json& document) const;

 private:
  std::string json_target_;
};

/// base::InputError about a file, or about an option or argument.
[[noreturn]] void refuseFile(const std::string& file, const std::string& reason, const std::string& remedy);
[[noreturn]] void refuseOption(const std::string& name, const std::string& value, const std::string& reason,
                               const std::string& remedy);

/// A notice for people, on standard error.
void notice(const std::string& text);

nlohmann::json toJson(const Eigen::Vector3d& vector);

/// Now, local time, ISO 8601 to the second.
std::string isoNow();

}  // namespace capstan::cli
