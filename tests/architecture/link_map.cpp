#include "tests/architecture/link_map.h"

#include <regex>
#include <sstream>

namespace capstan::architecture {

namespace fs = std::filesystem;

std::set<std::string> objectsTaken(const std::string& map) {
  std::set<std::string> taken;
  std::istringstream in(map);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("Archive member included")) return taken;
  // A line an object, and one of who requested it, which begins with blanks; the next part has a heading.
  const std::regex object("(?:[^ ]*/)?(lib[^/ ]+\\.a\\([^)]+\\.o\\)).*");
  std::smatch parts;
  while (std::getline(in, line)) {
    if (line.starts_with("Discarded input sections") || line.starts_with("Memory Configuration")) break;
    if (std::regex_match(line, parts, object)) taken.insert(parts[1]);
  }
  return taken;
}

std::string objectOf(const fs::path& source, const std::map<std::string, Room>& rooms) {
  for (fs::path folder = source.parent_path(); !folder.empty(); folder = folder.parent_path())
    if (const auto room = rooms.find(folder.generic_string()); room != rooms.end())
      return "libcapstan_" + room->second.target + ".a(" + source.filename().string() + ".o)";
  return {};
}

std::vector<std::string> unreached(const std::vector<fs::path>& sources,
                                   const std::map<std::string, Room>& rooms,
                                   const std::set<std::string>& taken) {
  std::vector<std::string> names;
  for (const fs::path& source : sources)
    if (!taken.contains(objectOf(source, rooms))) names.push_back(source.generic_string());
  return names;
}

}  // namespace capstan::architecture
