#include "tests/architecture/definitions.h"

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>
#include <string_view>

namespace capstan::architecture {
namespace {

/// True for a line that cannot begin a function: indented, a comment, the end of one, or another declaration.
bool isOther(std::string_view line) {
  static constexpr std::array<std::string_view, 9> kOthers = {
      "using ", "namespace ", "struct ", "class ", "enum ", "template", "static", "extern ", "typedef "};
  if (line.empty() || std::string_view("#/} \t").find(line.front()) != std::string_view::npos) return true;
  if (line.ends_with(';') && line.find('{') == std::string_view::npos) return true;
  return std::ranges::any_of(kOthers, [&](std::string_view start) { return line.starts_with(start); });
}

}  // namespace

std::set<std::string> functionsDefined(const std::string& text) {
  static const std::regex definition("[^(;=]*?((?:\\w+::)?~?\\w+)\\(.*");
  std::set<std::string> names;
  std::istringstream in(text);
  std::string line;
  std::smatch parts;
  bool anonymous = false;
  while (std::getline(in, line)) {
    if (line == "namespace {") anonymous = true;
    if (line == "}  // namespace") anonymous = false;
    if (anonymous || isOther(line)) continue;
    if (std::regex_match(line, parts, definition)) names.insert(parts[1]);
  }
  return names;
}

}  // namespace capstan::architecture
