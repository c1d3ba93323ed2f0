#include "core/diagnosis/report/extended_robot.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"

namespace capstan::diagnosis {
namespace {

/// Text without line breaks and control characters, because a comment ends with its line.
std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

/// "stribeck friction (joint 1), …": effects that are not causes.
std::string backgroundEffects(const Report& report) {
  std::string names;
  for (const robot::Effect& effect : report.extended.effects) {
    const auto is_it = [&](const Cause& c) { return c.effect == effect.effect && c.joint == effect.joint; };
    if (std::ranges::any_of(report.causes, is_it) || std::ranges::any_of(report.also_measurable, is_it))
      continue;
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", shownName(effect.effect),
                         shownJoint(effect.effect, effect.joint));
  }
  return names;
}

}  // namespace

std::string extendedRobotText(const Report& report, const std::string& software) {
  std::string recordings;
  for (const std::string& title : report.recordings) recordings += (recordings.empty() ? "" : ", ") + title;
  std::string text = "# Extended by a diagnosis of " + oneLine(recordings);
  if (!software.empty()) text += ", by " + oneLine(software);
  text +=
      report.causes.empty() ? "; no missing effect was identified.\n" : "; value ± one standard deviation:\n";
  for (const Cause& cause : report.causes)
    text +=
        fmt::format("#   {}; probability {:.0f} %\n", oneLine(causeText(cause)), 100.0 * cause.probability);
  if (!report.also_measurable.empty()) text += fmt::format("# {}:\n", alsoMeasurableTitle(report));
  for (const Cause& cause : report.also_measurable)
    text += fmt::format("#   {}\n", oneLine(causeText(cause)));
  if (const std::string background = backgroundEffects(report); !background.empty())
    text += "# Background effects, within their normal size: " + background + "\n";
  bool moved = false;
  for (const RefitNumber& one : report.refit) {
    if (!one.moved) continue;
    if (!moved) text += "# Parameters that the refit of the nominal model changed:\n";
    moved = true;
    text += fmt::format("#   {}: {} instead of {}\n", oneLine(shownName(one.name)),
                        shownNumber(one.value, one.sigma, one.unit), shownNumber(one.nominal, 0.0, one.unit));
  }
  return text + robot::formatDescription(report.extended);
}

}  // namespace capstan::diagnosis
