#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

/// The tree as folders and arrows: read from layers.txt, CMakeLists.txt and #include lines.
namespace capstan::architecture {

/// A folder with a CMake target: "core/diagnosis/fit", "widgets/panels/learning".
struct Room {
  std::string name;
  std::string target;                 ///< "diagnosis_fit"
  int layer = -1;                     ///< its line in layers.txt, from 0; −1: in none
  std::set<std::string> links;        ///< targets, directly
  int files = 0;                      ///< sources, without those of rooms inside
  std::map<std::string, int> arrows;  ///< other rooms of which it includes headers, and how many lines do
};

/// Sources under `folder`, sorted: .h, .cpp, .inc.
std::vector<std::filesystem::path> sourcesUnder(const std::filesystem::path& folder);

/// All first groups of `pattern` in `text`.
std::vector<std::string> matches(const std::string& text, const std::string& pattern);

/// The rooms below root/top ("core", "widgets") by name.
std::map<std::string, Room> roomsOf(const std::filesystem::path& root, const std::string& top);

/// Headers that `target` may include: everything that it links, directly or not. Targets by name.
std::set<std::string> reachableFrom(const std::string& target, const std::map<std::string, Room>& by_target);

}  // namespace capstan::architecture
