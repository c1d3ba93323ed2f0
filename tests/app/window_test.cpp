/// Runs the real window: exit codes of what cannot be shown.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/folders.h"

namespace capstan {
namespace {

struct Ran {
  int exit = -1;
  std::string said;
};

Ran run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  Ran result;
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) result.said.append(buffer, got);
  const int status = pclose(pipe);
  result.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

const std::string kWindow = test::windowProgram();

TEST(Window, UsageErrorsAreExitTwoWithoutADisplay) {
  const std::string window = "env -u DISPLAY " + kWindow;
  for (const char* wrong : {"--no-such-option", "--theme blue", "--seed x", "--session a --table b",
                            "--size 10x10", "--size 99999x800", "--size 1280x800x3", "--size big"})
    EXPECT_EQ(run(window + " " + wrong).exit, 2) << wrong;
  EXPECT_NE(run(window + " --size 10x10").said.find("--size = 10x10"), std::string::npos);
  EXPECT_NE(
      run(window + " --unregistered --session a.capstan").said.find("--session excludes --unregistered"),
      std::string::npos);
  EXPECT_NE(run(window + " --state paused").said.find("--state requires --screenshot"), std::string::npos);
  EXPECT_NE(run(window + " --show learn").said.find("--show requires --screenshot"), std::string::npos);
  EXPECT_EQ(run(window + " --screenshot a.png --show nothing").exit, 2);
  EXPECT_EQ(run(window + " --help").exit, 0);
  for (const char* text : {"capstan ", "\nOpenCV ", "\nQt ", "\nVTK "})
    EXPECT_NE(run(window + " --version").said.find(text), std::string::npos) << text;
  EXPECT_EQ(run(window).exit, 2) << "no display";
}

TEST(Window, APictureOfWhatCannotBeOpenedFails) {
  const std::filesystem::path picture =
      std::filesystem::temp_directory_path() / ("capstan_window_" + std::to_string(getpid()) + ".png");
  const Ran result = run("xvfb-run -a -s '-screen 0 1280x800x24 -noreset' " + kWindow +
                         " --session /nowhere/nofile.capstan --after 30 --screenshot " + picture.string());
  EXPECT_EQ(result.exit, 2) << result.said;
  EXPECT_NE(result.said.find("nofile.capstan"), std::string::npos) << result.said;
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Window, ATerminationSignalClosesItAsAPersonWould) {
  const std::string feed = "closing-" + std::to_string(getpid());
  const std::string segment = "/dev/shm/capstan-" + std::to_string(geteuid()) + "-" + feed;
  const std::string script = "'" + kWindow + " --simulate --size 1280x800 --monitor-feed " + feed +
                             " & window=$!; i=0; while [ ! -e " + segment +
                             " ] && [ $i -lt 600 ]; do sleep 0.1; i=$((i+1)); done; "
                             "[ -e " +
                             segment +
                             " ] || echo no segment; "
                             "kill -TERM $window; wait $window; echo exit $?'";
  const Ran result = run("xvfb-run -a -s '-screen 0 1280x800x24 -noreset' sh -c " + script);
  EXPECT_EQ(result.said.find("no segment"), std::string::npos) << result.said;
  EXPECT_NE(result.said.find("exit 0"), std::string::npos) << result.said;
  EXPECT_FALSE(std::filesystem::exists(segment));
}

}  // namespace
}  // namespace capstan
