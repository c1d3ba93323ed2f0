#include "app/cli/registrations_output.h"

#include <fmt/format.h>

#include <charconv>

#include "app/cli/console.h"
#include "core/base/units.h"
#include "core/vision/registration_file.h"

namespace capstan::cli {
namespace {

nlohmann::json numberOrNull(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json poseOrNull(const std::optional<Eigen::Isometry3d>& pose) {
  return pose ? toJson(*pose) : nlohmann::json(nullptr);
}

/// Number of an entry, 0 if `text` is none.
std::size_t numberIn(const std::string& text) {
  std::size_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc{} && end == text.data() + text.size() ? number : 0;
}

}  // namespace

std::string tableOf(std::span<const registration::HistoryEntry> entries) {
  if (entries.empty()) return "no registrations\n";
  std::string text = fmt::format("{:>4}  {:<19}  {:<8}  {:<13}  {:>9}  {:>6}  {}\n", "", "date", "decision",
                                 "method", "rms [mm]", "points", "robot, reason");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = entries[i];
    text += fmt::format("{:>4}  {:<19}  {:<8}  {:<13}  {:>9}  {:>6}  {}\n", i + 1, entry.date,
                        base::nameOf(entry.decision), base::nameOf(entry.method),
                        entry.rms ? fmt::format("{:.3f}", base::toMillimetres(*entry.rms)) : "-",
                        entry.used > 0 ? std::to_string(entry.used) : "-",
                        entry.reason.empty() ? entry.robot : entry.robot + ": " + entry.reason);
  }
  return text;
}

nlohmann::json documentOf(std::span<const registration::HistoryEntry> entries) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& entry : entries)
    list.push_back({{"date", entry.date},
                    {"decision", base::nameOf(entry.decision)},
                    {"method", base::nameOf(entry.method)},
                    {"robot", entry.robot},
                    {"session", entry.session},
                    {"reason", entry.reason},
                    {"rms", numberOrNull(entry.rms)},
                    {"leave_one_out_rms", numberOrNull(entry.leave_one_out_rms)},
                    {"used", entry.used},
                    {"excluded", entry.excluded},
                    {"base_from_camera", poseOrNull(entry.pose())}});
  return list;
}

nlohmann::json documentOf(const registration::RegistrationDifference& difference) {
  return {{"translation", toJson(Eigen::Vector3d(difference.translation))},
          {"rotation", difference.rotation},
          {"tool_median", difference.tool.median},
          {"tool_largest", difference.tool.largest}};
}

Eigen::Isometry3d registrationOf(const std::string& text,
                                 std::span<const registration::HistoryEntry> entries) {
  const std::size_t number = numberIn(text);
  if (number == 0 || entries.empty()) return vision::readRegistration(text);
  if (number > entries.size())
    refuseOption("registration", text, fmt::format("the history has {} entries", entries.size()),
                 "Give a number of the list, or a registration file");
  const auto pose = entries[number - 1].pose();
  if (!pose)
    refuseOption("registration", text, "this entry has no result: it was rejected before there was one",
                 "Give another one");
  return *pose;
}

}  // namespace capstan::cli
