#include "core/tracking/option_changes.h"

#include <sstream>
#include <vector>

namespace capstan::tracking {
namespace {

/// One text for each option, "key: value" without the unit.
std::vector<std::string> textsOf(const TrackingOptions& options) {
  std::vector<std::string> texts;
  std::istringstream lines(base::writeYaml(options));
  for (std::string line; std::getline(lines, line);) texts.push_back(line.substr(0, line.find(" #")));
  while (!texts.empty() && texts.back().find(':') == std::string::npos) texts.pop_back();
  for (std::string& text : texts) text.erase(text.find_last_not_of(' ') + 1);
  return texts;
}

}  // namespace

std::string optionChanges(const TrackingOptions& before, const TrackingOptions& after) {
  const auto was = textsOf(before), is = textsOf(after);
  std::string words;
  for (std::size_t i = 0; i < is.size(); ++i)
    if (was[i] != is[i]) words += (words.empty() ? "" : ", ") + is[i];
  return words;
}

}  // namespace capstan::tracking
