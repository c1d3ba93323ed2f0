// Whatever core/ holds is reached by a person: each of its sources is linked into the window, the command
// line or the monitor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/yaml.h"
#include "tests/architecture/definitions.h"
#include "tests/architecture/link_map.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using architecture::LinkedParts;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

const fs::path kRoot = test::sourceFile();

/// Sources of core/ by path relative to the root, with their texts; without kernels that this machine's
/// compiler does not build, and without core/ros1, of which configure chooses the sources.
std::map<fs::path, std::string> coreSources() {
  std::map<fs::path, std::string> sources;
  for (const fs::path& file : architecture::sourcesUnder(kRoot / "core")) {
    if (file.parent_path().filename() == "ros1") continue;
#ifndef __x86_64__
    if (file.filename().string().find("_avx") != std::string::npos) continue;
#endif
    if (file.extension() == ".cpp") sources[file.lexically_relative(kRoot)] = base::readTextFile(file);
  }
  return sources;
}

/// Two rooms, one inside the other.
std::map<std::string, architecture::Room> someRooms() {
  std::map<std::string, architecture::Room> rooms;
  rooms["core/diagnosis"].target = "diagnosis";
  rooms["core/diagnosis/fit"].target = "diagnosis_fit";
  return rooms;
}

TEST(Reach, EverySourceOfCoreIsInAProgram) {
  LinkedParts parts;
  for (const char* file : {CAPSTAN_CLI_MAP, CAPSTAN_WINDOW_MAP, CAPSTAN_MONITOR_MAP})
    ASSERT_TRUE(architecture::addMap(base::readTextFile(file), parts))
        << file << " is no map of GNU ld or gold: link with it, or leave this test out";
  const auto sources = coreSources();
  ASSERT_GE(sources.size(), 200U);
  EXPECT_THAT(architecture::unreached(sources, architecture::roomsOf(kRoot, "core"), parts), IsEmpty())
      << "Reach these from a command or a panel, delete them, or move them to tests/support";
}

TEST(Reach, ObjectsAndFunctionsAreReadFromAMap) {
  LinkedParts parts;
  EXPECT_TRUE(architecture::addMap(
      "Archive member included to satisfy reference by file (symbol)\n\n"
      "core/robot/libcapstan_robot.a(chain.cpp.o)\n"
      "                              app/main.cpp.o (capstan::robot::chain())\n"
      "libcapstan_base.a(error.cpp.o) core/robot/libcapstan_robot.a(asker.cpp.o) (capstan::base::Error())\n"
      "\nDiscarded input sections\n\n"
      " .text._ZN7capstan5robot4lateEv\n"
      "                0x00 0x10 core/robot/libcapstan_robot.a(late.cpp.o)\n"
      "\nMemory map\n\n"
      " .text          0x0000000000001000       0x40 core/robot/libcapstan_robot.a(chain.cpp.o)\n"
      " .text._ZN7capstan5robot5Chain4stepEd\n"
      "                0x0000000000001040       0x10 core/robot/libcapstan_robot.a(unity_0_cxx.cxx.o)\n"
      " .text._ZN7capstan4base3oddEv 0x1050 0x10 libcapstan_base.a(error.cpp.o)\n",
      parts));
  EXPECT_THAT(parts.objects,
              ElementsAre("libcapstan_base.a(error.cpp.o)", "libcapstan_robot.a(chain.cpp.o)"));
  EXPECT_THAT(parts.names, ElementsAre(Pair("libcapstan_base.a", ElementsAre("base::odd")),
                                       Pair("libcapstan_robot.a", ElementsAre("Chain::step"))));
  EXPECT_FALSE(architecture::addMap("VMA LMA Size Align Out In Symbol\n", parts));
}

TEST(Reach, SymbolsHaveTheNamesOfTheirSources) {
  EXPECT_EQ(architecture::nameOfSymbol("_ZNK7capstan5robot5Chain4stepEd"), "Chain::step");
  EXPECT_EQ(architecture::nameOfSymbol("_ZN7capstan5robot5ChainC2Ev"), "Chain::Chain");
  EXPECT_EQ(architecture::nameOfSymbol("_ZN7capstan5robot5ChainD1Ev.cold"), "Chain::~Chain");
  EXPECT_EQ(architecture::nameOfSymbol("_ZN7capstan5robot7chainOfEv"), "robot::chainOf");
  EXPECT_EQ(architecture::nameOfSymbol("_ZN7capstan5robot12_GLOBAL__N_16helperEv"), "");
  EXPECT_EQ(architecture::nameOfSymbol("main"), "");
}

TEST(Reach, DefinitionsAreReadFromASource) {
  EXPECT_THAT(architecture::functionsDefined("namespace capstan::robot {\n"
                                             "void declared(int);\n"
                                             "namespace {\nint helper() { return 1; }\n}  // namespace\n"
                                             "// a comment (of this)\n"
                                             "Chain::Chain(int n)\n    : n_(n) {}\n"
                                             "Chain::~Chain() = default;\n"
                                             "const std::vector<int>& Chain::numbers() const {\n"
                                             "  return numbersOf(n_);\n}\n"
                                             "double chainOf(const Chain& chain,\n"
                                             "               double x) { return x; }\n"),
              ElementsAre("Chain::Chain", "Chain::numbers", "chainOf"));
}

TEST(Reach, ASourceBelongsToTheInnermostRoom) {
  EXPECT_EQ(architecture::libraryOf("core/diagnosis/fit/robot/chain.cpp", someRooms()),
            "libcapstan_diagnosis_fit.a");
  EXPECT_EQ(architecture::libraryOf("core/other/chain.cpp", someRooms()), "");
}

TEST(Reach, ASourceIsReachedByItsObjectOrByAFunctionOfItsOwn) {
  LinkedParts parts;
  parts.objects = {"libcapstan_diagnosis.a(a.cpp.o)", "libcapstan_other.a(b.cpp.o)"};
  parts.names["libcapstan_diagnosis_fit.a"] = {"diagnosis::fitOf", "diagnosis::both", "Fit::part"};
  EXPECT_THAT(architecture::unreached({{"core/diagnosis/a.cpp", ""},
                                       {"core/diagnosis/b.cpp", ""},
                                       {"core/diagnosis/fit/fit.cpp", "int fitOf() {\n"},
                                       {"core/diagnosis/fit/late.cpp", "int both() {\nint late() {\n"},
                                       {"core/diagnosis/fit/member.cpp", "int both() {\nint Fit::part() {\n"},
                                       {"core/diagnosis/fit/part.cpp", "int part() {\n"},
                                       {"core/stray.cpp", "int fitOf() {\n"}},
                                      someRooms(), parts),
              ElementsAre("core/diagnosis/b.cpp", "core/diagnosis/fit/late.cpp",
                          "core/diagnosis/fit/part.cpp", "core/stray.cpp"));
}

}  // namespace
}  // namespace capstan
