#include "tests/architecture/link_map.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "tests/architecture/definitions.h"

namespace capstan::architecture {

namespace fs = std::filesystem;

namespace {

/// "libcapstan_robot.a(chain.cpp.o)" of a line that begins or ends with that object's path; empty: it has
/// none.
std::string_view objectIn(std::string_view line) {
  const std::size_t member = line.find(".a(");
  if (member == std::string_view::npos) return {};
  const std::size_t end = line.find(')', member), space = line.rfind(' ', member);
  if (end == std::string_view::npos) return {};
  std::string_view path = line.substr(space == std::string_view::npos ? 0 : space + 1);
  path = path.substr(0, path.find(')') + 1);
  return path.substr(path.rfind('/', path.find(".a(")) + 1);
}

/// The symbol of a section of its own: _ZN… of ".text._ZN…", ".text.unlikely._ZN…" or ".rodata._ZN…".
std::string_view symbolOf(std::string_view section) {
  const std::size_t at = section.find("._Z");
  return at == std::string_view::npos ? std::string_view() : section.substr(at + 1);
}

/// Adds the name of a section, e.g. " .text._ZN…", of the object that `line` ends with.
void addSection(std::string_view section, std::string_view line, LinkedParts& parts) {
  const std::string name = nameOfSymbol(symbolOf(section));
  const std::string_view object = objectIn(line);
  if (!name.empty() && !object.empty())
    parts.names[std::string(object.substr(0, object.find('(')))].insert(name);
}

bool isIn(const std::set<std::string>& names, const std::string& function) {
  if (function.find("::") != std::string::npos) return names.contains(function);
  return std::ranges::any_of(names, [&](const std::string& name) {  // a namespace's name is in lower case
    return std::islower(static_cast<unsigned char>(name.front())) && name.ends_with("::" + function);
  });
}

}  // namespace

bool addMap(const std::string& map, LinkedParts& parts) {
  std::istringstream in(map);
  std::string line, section;
  if (!std::getline(in, line) || !line.starts_with("Archive member included")) return false;
  // A line an object, and one of what requested it, which begins with blanks; the next part has a heading.
  while (std::getline(in, line)) {
    if (line.starts_with("Discarded input sections") || line.starts_with("Memory ")) break;
    if (!line.starts_with(' '))
      if (const std::string_view object = objectIn(std::string_view(line).substr(0, line.find(' ')));
          !object.empty())
        parts.objects.emplace(object);
  }
  while (!line.starts_with("Memory map") && !line.starts_with("Linker script and memory map"))
    if (!std::getline(in, line)) return true;
  // Name, address, size and object of each section; a long name has the line before the others.
  while (std::getline(in, line)) {
    if (line.starts_with(" .")) {
      section = line.substr(1, line.find(' ', 1) - 1);
      if (line.size() <= section.size() + 1) continue;
      addSection(section, line, parts);
    } else if (!section.empty()) {
      addSection(section, line, parts);
    }
    section.clear();
  }
  return true;
}

std::string nameOfSymbol(std::string_view symbol) {
  if (!symbol.starts_with("_ZN")) return {};
  symbol.remove_prefix(3);
  while (!symbol.empty() && std::string_view("KVrRO").find(symbol.front()) != std::string_view::npos)
    symbol.remove_prefix(1);
  std::vector<std::string> parts;
  while (!symbol.empty() && std::isdigit(static_cast<unsigned char>(symbol.front()))) {
    std::size_t length = 0;
    for (; !symbol.empty() && std::isdigit(static_cast<unsigned char>(symbol.front()));
         symbol.remove_prefix(1))
      length = 10 * length + static_cast<std::size_t>(symbol.front() - '0');
    parts.emplace_back(symbol.substr(0, length));
    symbol.remove_prefix(std::min(length, symbol.size()));
    if (parts.back() == "_GLOBAL__N_1") return {};
  }
  if (parts.empty()) return {};
  const bool special = symbol.size() > 1 && std::isdigit(static_cast<unsigned char>(symbol[1]));
  if (special && symbol.front() == 'C') parts.push_back(parts.back());        // constructor
  if (special && symbol.front() == 'D') parts.push_back("~" + parts.back());  // destructor
  return parts.size() < 2 ? std::string() : parts[parts.size() - 2] + "::" + parts.back();
}

std::string libraryOf(const fs::path& source, const std::map<std::string, Room>& rooms) {
  for (fs::path folder = source.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (const auto room = rooms.find(folder.generic_string()); room != rooms.end())
      return "libcapstan_" + room->second.target + ".a";
  return {};
}

std::vector<std::string> unreached(const std::map<fs::path, std::string>& sources,
                                   const std::map<std::string, Room>& rooms, const LinkedParts& parts) {
  std::map<fs::path, std::set<std::string>> functions;
  std::map<std::string, std::map<std::string, int>> counts;  // of sources that define a function, by library
  for (const auto& [source, text] : sources) {
    functions[source] = functionsDefined(text);
    for (const std::string& function : functions[source]) ++counts[libraryOf(source, rooms)][function];
  }
  std::vector<std::string> names;
  for (const auto& [source, defined] : functions) {
    const std::string library = libraryOf(source, rooms);
    if (parts.objects.contains(library + "(" + source.filename().string() + ".o)")) continue;
    const auto own = [&](const std::string& function) { return counts[library][function] == 1; };
    const bool any = std::ranges::none_of(defined, own);
    const auto taken = parts.names.find(library);
    if (taken == parts.names.end() || std::ranges::none_of(defined, [&](const std::string& function) {
          return (any || own(function)) && isIn(taken->second, function);
        }))
      names.push_back(source.generic_string());
  }
  return names;
}

}  // namespace capstan::architecture
