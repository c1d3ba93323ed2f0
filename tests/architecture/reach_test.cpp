// Whatever core/ holds is reached by a person: each of its sources is linked into the window or the command
// line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/yaml.h"
#include "tests/architecture/link_map.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const fs::path kRoot = test::sourceFile();

/// Sources of core/, relative to the root; without kernels that this machine's compiler does not build, and
/// without core/ros1, of which configure chooses the sources.
std::vector<fs::path> coreSources() {
  std::vector<fs::path> sources;
  for (const fs::path& file : architecture::sourcesUnder(kRoot / "core")) {
    if (file.parent_path().filename() == "ros1") continue;
#ifndef __x86_64__
    if (file.filename().string().find("_avx") != std::string::npos) continue;
#endif
    if (file.extension() == ".cpp") sources.push_back(file.lexically_relative(kRoot));
  }
  return sources;
}

TEST(Reach, EverySourceOfCoreIsInAProgram) {
  std::set<std::string> taken;
  for (const char* file : {CAPSTAN_CLI_MAP, CAPSTAN_WINDOW_MAP, CAPSTAN_MONITOR_MAP}) {
    std::set<std::string> one = architecture::objectsTaken(base::readTextFile(file));
    ASSERT_FALSE(one.empty()) << file << " is no map of GNU ld: link with it, or leave this test out";
    taken.merge(one);
  }
  const auto sources = coreSources();
  ASSERT_GE(sources.size(), 200U);
  EXPECT_THAT(architecture::unreached(sources, architecture::roomsOf(kRoot, "core"), taken), IsEmpty())
      << "Reach these from a command or a panel, delete them, or move them to tests/support";
}

TEST(Reach, ObjectsAreReadFromTheMapsFirstPart) {
  const std::string map =
      "Archive member included to satisfy reference by file (symbol)\n\n"
      "core/robot/libcapstan_robot.a(chain.cpp.o)\n"
      "                              app/main.cpp.o (capstan::robot::chain())\n"
      "libcapstan_base.a(error.cpp.o) core/robot/libcapstan_robot.a(asker.cpp.o) (capstan::base::Error())\n"
      "\nDiscarded input sections\n\n"
      "core/robot/libcapstan_robot.a(late.cpp.o)\n";
  EXPECT_THAT(architecture::objectsTaken(map),
              ElementsAre("libcapstan_base.a(error.cpp.o)", "libcapstan_robot.a(chain.cpp.o)"));
  EXPECT_THAT(architecture::objectsTaken("VMA LMA Size Align Out In Symbol\n"), IsEmpty());
}

TEST(Reach, ASourceBelongsToTheInnermostRoom) {
  std::map<std::string, architecture::Room> rooms;
  rooms["core/diagnosis"].target = "diagnosis";
  rooms["core/diagnosis/fit"].target = "diagnosis_fit";
  EXPECT_EQ(architecture::objectOf("core/diagnosis/fit/robot/chain.cpp", rooms),
            "libcapstan_diagnosis_fit.a(chain.cpp.o)");
  EXPECT_EQ(architecture::objectOf("core/other/chain.cpp", rooms), "");
  EXPECT_THAT(
      architecture::unreached({"core/diagnosis/a.cpp", "core/diagnosis/b.cpp", "core/stray.cpp"}, rooms,
                              {"libcapstan_diagnosis.a(a.cpp.o)", "libcapstan_other.a(b.cpp.o)"}),
      ElementsAre("core/diagnosis/b.cpp", "core/stray.cpp"));
}

}  // namespace
}  // namespace capstan
