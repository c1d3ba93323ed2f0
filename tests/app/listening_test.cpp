// Nothing listens without being asked: sockets of running programs, by /proc.
#include <chrono>
#include <set>
#include <thread>

#include "tests/app/cli_fixture.h"
#include "tests/support/listening_sockets.h"

namespace capstan::testing {
namespace {

using namespace std::chrono_literals;

class Listening : public Cli {
 protected:
  /// Starts a shell command whose process id is $!, and gives that.
  pid_t start(const std::string& command, const std::string& around = "sh") const {
    write("start.sh", command + " >out.txt 2>err.txt & echo $! >pid.tmp; mv pid.tmp pid.txt; wait\n");
    fs::remove(path("pid.txt"));
    runShell("cd " + folder_.string() + " && " + around + " start.sh >/dev/null 2>&1 &");
    for (int k = 0; k < 1000 && !fs::exists(path("pid.txt")); ++k) std::this_thread::sleep_for(10ms);
    return fs::exists(path("pid.txt")) ? std::stoi(textOf("pid.txt")) : -1;
  }
  /// All addresses at which the process listened until it ended or `most` had passed; then it is ended. It
  /// must have run for `least`.
  std::set<std::string> listenedAt(pid_t process, std::chrono::milliseconds least,
                                   std::chrono::milliseconds most) const {
    std::set<std::string> addresses;
    const auto begin = std::chrono::steady_clock::now();
    const auto spent = [&] { return std::chrono::steady_clock::now() - begin; };
    while (spent() < most && kill(process, 0) == 0) {
      for (const std::string& address : listeningSockets(process)) addresses.insert(address);
      std::this_thread::sleep_for(20ms);
    }
    EXPECT_GE(spent(), least) << textOf("err.txt");
    kill(process, SIGTERM);
    while (kill(process, 0) == 0) std::this_thread::sleep_for(20ms);
    return addresses;
  }
  const std::string program_ = test::commandLineProgram(), window_ = test::windowProgram(),
                    display_ = "xvfb-run -a -s '-screen 0 1280x800x24 -noreset' sh";
};

using Addresses = std::set<std::string>;

TEST_F(Listening, ACommandListensNowhereUnasked) {
  ASSERT_EQ(run("simulate --duration 3 --out " + path("trial.capstan")).exit, 0);
  for (const char* arguments :
       {"track --simulate --duration 100 --out estimates.csv", "simulate --duration 100 --out other.capstan",
        "track trial.capstan", "report --out report", "devices", "diagnose trial.capstan",
        "track --live rows.fifo --out estimates.csv", "record --live rows.fifo --out live.capstan"}) {
    runShell("cd " + folder_.string() + " && rm -f rows.fifo other.capstan live.capstan && mkfifo rows.fifo");
    EXPECT_EQ(listenedAt(start(program_ + " " + arguments), 0ms, 1500ms), Addresses{}) << arguments;
  }
}

TEST_F(Listening, ACommandListensOnLoopbackWhenAsked) {
  const auto listened =
      listenedAt(start(program_ + " track --live tcp://127.0.0.1:0 --out tcp://127.0.0.1:0"), 1500ms, 1500ms);
  EXPECT_EQ(listened.size(), 2U) << "for rows and for estimates";
  for (const std::string& address : listened) EXPECT_TRUE(address.starts_with("tcp 127.0.0.1:")) << address;
}

TEST_F(Listening, TheWindowListensNowhereUnasked) {
  EXPECT_EQ(listenedAt(start(window_ + " --simulate --size 1280x800", display_), 6000ms, 6000ms),
            Addresses{});
}

TEST_F(Listening, TheWindowListensOnLoopbackWhenAsked) {
  const auto listened =
      listenedAt(start(window_ + " --live tcp://127.0.0.1:0 --size 1280x800", display_), 6000ms, 6000ms);
  ASSERT_EQ(listened.size(), 1U);
  EXPECT_TRUE(listened.begin()->starts_with("tcp 127.0.0.1:")) << *listened.begin();
}

}  // namespace
}  // namespace capstan::testing
