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
#include "tests/architecture/include_graph.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = test::sourceFile();

using architecture::matches;
using architecture::Room;
using architecture::sourcesUnder;

std::map<std::string, Room> allRooms() {
  std::map<std::string, Room> rooms = architecture::roomsOf(kRoot, "core");
  rooms.merge(architecture::roomsOf(kRoot, "widgets"));
  return rooms;
}

std::map<std::string, Room> byTarget(const std::map<std::string, Room>& rooms) {
  std::map<std::string, Room> targets;
  for (const auto& [name, room] : rooms) targets[room.target] = room;
  return targets;
}

bool ofOneTree(const std::string& a, const std::string& b) {
  return a.substr(0, a.find('/')) == b.substr(0, b.find('/'));
}

TEST(Architecture, EveryRoomHasALayerAndATarget) {
  const auto rooms = allRooms();
  ASSERT_GE(rooms.size(), 35U);
  for (const auto& [name, room] : rooms) {
    EXPECT_GE(room.layer, 0) << name << " stands in no line of layers.txt";
    EXPECT_FALSE(room.target.empty()) << name;
  }
}

/// No cycle can close, as each arrow goes to a lower line.
TEST(Architecture, ArrowsPointDownwards) {
  const auto rooms = allRooms();
  for (const auto& [name, room] : rooms)
    for (const auto& [used, lines] : room.arrows) {
      if (ofOneTree(name, used)) {
        EXPECT_LT(rooms.at(used).layer, room.layer) << name << " includes " << used;
      } else {
        EXPECT_TRUE(used.starts_with("core/")) << name << " includes " << used;
      }
    }
}

TEST(Architecture, LinksPointDownwards) {
  const auto rooms = allRooms();
  const auto targets = byTarget(rooms);
  for (const auto& [name, room] : rooms)
    for (const std::string& link : room.links) {
      const auto linked = targets.find(link);
      ASSERT_NE(linked, targets.end()) << name << " links " << link;
      if (ofOneTree(name, linked->second.name)) {
        EXPECT_LT(linked->second.layer, room.layer) << name << " links " << link;
      }
    }
}

TEST(Architecture, ARoomIncludesOnlyWhatItLinks) {
  const auto rooms = allRooms();
  const auto targets = byTarget(rooms);
  for (const auto& [name, room] : rooms) {
    const auto allowed = architecture::reachableFrom(room.target, targets);
    for (const auto& [used, lines] : room.arrows)
      EXPECT_TRUE(allowed.contains(rooms.at(used).target)) << name << " includes " << used;
  }
}

TEST(Architecture, CoreKnowsNoWindowAndNoApplication) {
  const std::regex forbidden("#include [<\"](Q[A-Z]|qcustomplot|vtk|GLFW|widgets/|app/)");
  for (const auto& file : sourcesUnder(kRoot / "core"))
    EXPECT_FALSE(std::regex_search(base::readTextFile(file), forbidden)) << file;
}

TEST(Architecture, WidgetsKnowNoApplication) {
  for (const auto& file : sourcesUnder(kRoot / "widgets"))
    EXPECT_EQ(base::readTextFile(file).find("#include \"app/"), std::string::npos) << file;
}

TEST(Architecture, FiguresDrawWithoutADisplay) {
  for (const auto& file : sourcesUnder(kRoot / "widgets" / "figures"))
    EXPECT_FALSE(std::regex_search(base::readTextFile(file), std::regex("#include [<\"]vtk"))) << file;
}

/// The plant is the richer one: what the filter believes never drives it.
TEST(Architecture, TheSimulatedPlantIsNotTheFilterModel) {
  for (const auto& file : sourcesUnder(kRoot / "core" / "simulation"))
    for (const char* model : {"cable_arm_model", "cable_arm_kernel"})
      EXPECT_EQ(base::readTextFile(file).find(model), std::string::npos) << file;
}

/// The plant that hides faults from the diagnosis shares no model with anybody: it knows the robot file, the
/// measured table and random numbers.
TEST(Architecture, ThePlantedPlantIsNobodysModel) {
  const auto files = sourcesUnder(kRoot / "tests" / "support" / "planted");
  ASSERT_FALSE(files.empty());
  const std::set<std::string> allowed = {"robot/description.h", "recording/measured_table.h",
                                         "base/random.h"};
  for (const auto& file : files)
    for (const auto& used : matches(base::readTextFile(file), "#include \"core/([a-z_/]+\\.h)\""))
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
}  // namespace capstan
