#include "tests/architecture/include_graph.h"

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

#include "core/base/yaml.h"

namespace capstan::architecture {
namespace {

namespace fs = std::filesystem;

/// Lines of layers.txt by folder.
std::map<std::string, int> layersOf(const fs::path& top) {
  std::map<std::string, int> layers;
  std::istringstream in(base::readTextFile(top / "layers.txt"));
  int layer = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream folders(line);
    for (std::string folder; folders >> folder;) layers[folder] = layer;
    ++layer;
  }
  return layers;
}

/// The innermost of `rooms` that holds `path` ("core/diagnosis/fit/fit.h"); empty: none.
std::string roomOf(fs::path path, const std::set<std::string>& rooms) {
  while (path.has_relative_path() && path != path.parent_path()) {
    path = path.parent_path();
    if (rooms.contains(path.generic_string())) return path.generic_string();
  }
  return {};
}

/// Every folder with a target, of core and of widgets.
std::set<std::string> allRooms(const fs::path& root) {
  std::set<std::string> rooms;
  for (const char* top : {"core", "widgets"})
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().filename() != "CMakeLists.txt" || entry.path().parent_path() == root / top) continue;
      rooms.insert(entry.path().parent_path().lexically_relative(root).generic_string());
    }
  return rooms;
}

}  // namespace

std::vector<fs::path> sourcesUnder(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::exists(folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".h" || ending == ".cpp" || ending == ".inc") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

std::map<std::string, Room> roomsOf(const fs::path& root, const std::string& top) {
  const std::set<std::string> names = allRooms(root);
  const auto layers = layersOf(root / top);
  std::map<std::string, Room> rooms;
  for (const std::string& name : names) {
    if (!name.starts_with(top + "/")) continue;
    Room& room = rooms[name];
    room.name = name;
    const auto layer = layers.find(name.substr(top.size() + 1));
    if (layer != layers.end()) room.layer = layer->second;
    const std::string cmake =
        std::regex_replace(base::readTextFile(root / name / "CMakeLists.txt"), std::regex("#[^\n]*"), "");
    if (const auto target = matches(cmake, "NAME ([a-z0-9_]+)"); !target.empty())
      room.target = target.front();
    const auto links = matches(cmake, "capstan::([a-z0-9_]+)");
    room.links = {links.begin(), links.end()};
  }
  for (const fs::path& file : sourcesUnder(root / top)) {
    const std::string own = roomOf(file.lexically_relative(root), names);
    ++rooms[own].files;
    for (const std::string& header :
         matches(base::readTextFile(file), "#include \"((?:core|widgets)/[^\"]+)\"")) {
      const std::string used = roomOf(header, names);
      if (used != own) ++rooms[own].arrows[used];
    }
  }
  return rooms;
}

std::set<std::string> reachableFrom(const std::string& target, const std::map<std::string, Room>& by_target) {
  std::set<std::string> reached;
  std::vector<std::string> open = {target};
  while (!open.empty()) {
    const auto room = by_target.find(open.back());
    open.pop_back();
    if (room == by_target.end()) continue;
    for (const std::string& link : room->second.links)
      if (reached.insert(link).second) open.push_back(link);
  }
  return reached;
}

}  // namespace capstan::architecture
