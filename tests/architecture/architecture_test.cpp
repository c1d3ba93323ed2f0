// Holds the tree to its layers: a room includes only what its CMake target links, links point downwards, and
// core/ knows no window library.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/base/yaml.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = CAPSTAN_SOURCE_DIR;

/// Lowest first; rooms of one line may not use each other.
const std::vector<std::set<std::string>> kLayers = {{"base"},
                                                    {"math"},
                                                    {"stats"},
                                                    {"vision", "robot", "estimation"},
                                                    {"tracking", "learning"},
                                                    {"session"},
                                                    {"simulation", "identification"},
                                                    {"diagnosis", "experiments"}};

int layerOf(const std::string& room) {
  for (std::size_t i = 0; i < kLayers.size(); ++i)
    if (kLayers[i].contains(room)) return static_cast<int>(i);
  return -1;
}

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

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

std::set<std::string> coreRooms() {
  std::set<std::string> rooms;
  for (const auto& entry : fs::directory_iterator(kRoot / "core"))
    if (entry.is_directory() && fs::exists(entry.path() / "CMakeLists.txt"))
      rooms.insert(entry.path().filename().string());
  return rooms;
}

std::set<std::string> linksOf(const std::string& room) {
  const std::string text = capstan::base::readTextFile(kRoot / "core" / room / "CMakeLists.txt");
  const auto links = matches(text, std::regex("capstan::([a-z_]+)"));
  return {links.begin(), links.end()};
}

std::set<std::string> reachableFrom(const std::string& room) {
  std::set<std::string> reached;
  std::vector<std::string> open = {room};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const auto& link : linksOf(next))
      if (reached.insert(link).second) open.push_back(link);
  }
  return reached;
}

TEST(Architecture, EveryRoomHasALayer) {
  ASSERT_GE(coreRooms().size(), 9U);
  for (const auto& room : coreRooms()) EXPECT_GE(layerOf(room), 0) << room << " stands in no layer";
}

TEST(Architecture, LinksPointDownwards) {
  for (const auto& room : coreRooms())
    for (const auto& link : linksOf(room))
      EXPECT_LT(layerOf(link), layerOf(room)) << "core/" << room << " links " << link;
}

TEST(Architecture, ARoomIncludesOnlyWhatItLinks) {
  for (const auto& room : coreRooms()) {
    auto allowed = reachableFrom(room);
    allowed.insert(room);
    for (const auto& file : sourcesUnder(kRoot / "core" / room))
      for (const auto& used :
           matches(capstan::base::readTextFile(file), std::regex("#include \"core/([a-z_]+)/")))
        EXPECT_TRUE(allowed.contains(used)) << file << " includes core/" << used;
  }
}

TEST(Architecture, CoreKnowsNoWindowAndNoApplication) {
  const std::regex forbidden("#include [<\"](Q[A-Z]|qcustomplot|vtk|GLFW|widgets/|app/)");
  for (const auto& file : sourcesUnder(kRoot / "core"))
    EXPECT_FALSE(std::regex_search(capstan::base::readTextFile(file), forbidden)) << file;
}

TEST(Architecture, WidgetsKnowNoApplication) {
  for (const auto& file : sourcesUnder(kRoot / "widgets"))
    EXPECT_EQ(capstan::base::readTextFile(file).find("#include \"app/"), std::string::npos) << file;
}

TEST(Architecture, FiguresDrawWithoutADisplay) {
  for (const auto& file : sourcesUnder(kRoot / "widgets" / "figures"))
    EXPECT_FALSE(std::regex_search(capstan::base::readTextFile(file), std::regex("#include [<\"]vtk")))
        << file;
}

/// The plant is the richer one: what the filter believes never drives it.
TEST(Architecture, TheSimulatedPlantIsNotTheFilterModel) {
  for (const auto& file : sourcesUnder(kRoot / "core" / "simulation"))
    for (const char* model : {"cable_arm_model", "cable_arm_kernel"})
      EXPECT_EQ(capstan::base::readTextFile(file).find(model), std::string::npos) << file;
}

/// The plant that hides faults from the diagnosis shares no model with anybody: it knows the robot file, the
/// measured table and random numbers.
TEST(Architecture, ThePlantedPlantIsNobodysModel) {
  const auto files = sourcesUnder(kRoot / "tests" / "support" / "planted");
  ASSERT_FALSE(files.empty());
  const std::set<std::string> allowed = {"robot/description.h", "session/measured_table.h", "base/random.h"};
  for (const auto& file : files)
    for (const auto& used :
         matches(capstan::base::readTextFile(file), std::regex("#include \"core/([a-z_/]+\\.h)\"")))
      EXPECT_TRUE(allowed.contains(used)) << file << " includes core/" << used;
}

TEST(Architecture, AFileHoldsOneIdea) {
  for (const char* top : {"core", "widgets", "app", "tests"})
    for (const auto& file : sourcesUnder(kRoot / top)) {
      std::ifstream in(file);
      const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
      EXPECT_LE(lines, 400) << file;
    }
}

}  // namespace
