/// Commands to a simulated robot over a real ROS master of this computer.
#include "core/live/joint_commander.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "core/base/error.h"
#include "core/live/live_source.h"
#include "core/ros1/master_topics.h"
#include "core/ros1/ros_topics.h"
#include "tests/core/live/setup_fault.h"
#include "tests/support/servo_robot.h"

extern char** environ;

namespace capstan::live {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using testing::kServoOffsets, testing::kServoPlaces, testing::kServoSigns;

CommandsSetup commandsOfTheRobot() {
  CommandsSetup setup;
  setup.servo_jp = "/arm/servo_jp", setup.measured = "/arm/measured_js";
  setup.names = {"yaw", "pitch", "insertion"};
  setup.signs = kServoSigns, setup.offsets = kServoOffsets;
  setup.speed = {0.2, 0.2, 0.02};
  return setup;
}

ros1::JointState messageOfTheRobot() {
  return {{},
          {testing::kServoNames.begin(), testing::kServoNames.end()},
          {0.7, 0.4, -0.4, 0.52, -2.2, 0.3},
          {},
          {}};
}

TEST(JointCommand, ReplacesThreePositionsOfTheRobotsOwnMessage) {
  const CommandsSetup setup = commandsOfTheRobot();
  const ros1::JointState measured = messageOfTheRobot();
  const ros1::JointState command = commandOf(setup, setup.names, {0.2, 2.3, 0.55}, &measured);
  EXPECT_EQ(command.name, measured.name);
  EXPECT_EQ(command.position, (std::vector<double>{0.7, 0.2 + 0.1, -0.4, 0.55 - 0.02, -2.3, 0.3}));
  EXPECT_EQ(commandOf(setup, setup.names, {0.2, 2.3, 0.55}, nullptr).position,
            (std::vector<double>{0.2 + 0.1, -2.3, 0.55 - 0.02}));
}

TEST(JointCommand, NamesTheJointThatDisagrees) {
  CommandsSetup setup = commandsOfTheRobot();
  const Eigen::Vector3d tolerance(0.05, 0.05, 0.01);
  EXPECT_EQ(disagreementOf(setup, setup.names, {0.3, 2.2, 0.54}, tolerance, messageOfTheRobot()), "");
  setup.signs[1] = 1.0;
  EXPECT_NE(
      disagreementOf(setup, setup.names, {0.3, 2.2, 0.54}, tolerance, messageOfTheRobot()).find("pitch"),
      std::string::npos);
  setup.names = {"yaw", "pitch", "elbow"};
  const ros1::JointState measured = messageOfTheRobot();
  EXPECT_THROW(commandOf(setup, setup.names, {0.3, 2.2, 0.54}, &measured), base::InputError);
}

class Process {
 public:
  explicit Process(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (posix_spawnp(&id_, arguments[0], &quiet, nullptr, arguments.data(), environ) != 0) id_ = 0;
    posix_spawn_file_actions_destroy(&quiet);
  }
  ~Process() {
    if (id_ == 0) return;
    send(SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  void send(int signal) const { kill(id_, signal); }
  bool started() const { return id_ != 0; }

 private:
  pid_t id_ = 0;
};

/// A master, the robot, and a session with it whose samples are taken all the time.
class CommandedRobot : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v rosmaster >/dev/null 2>&1") != 0) GTEST_SKIP() << "ROS 1 is not installed";
    const std::string port = std::to_string(20000 + getpid() % 20000);
    setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + port).c_str(), 1);
    setenv("ROS_HOSTNAME", "127.0.0.1", 1);
    try {
      ros1::masterAddress();
    } catch (const base::InputError& error) {
      GTEST_SKIP() << error.what();
    }
    master_.emplace(std::vector<std::string>{"rosmaster", "--core", "-p", port});
    ASSERT_TRUE(master_->started());
    ASSERT_TRUE(eventually(10s, [] { return ros1::isMasterThere(); }));
    robot_.emplace(std::vector<std::string>{CAPSTAN_SERVO_ROBOT, log_.string()});
    ASSERT_TRUE(robot_->started());
    LiveSetup setup;
    setup.motors.from = "ros:/arm/actuators/measured_js";
    setup.commands = commandsOfTheRobot();
    change(setup);
    session_ = std::make_unique<LiveSource>(setup);
    commander_ = session_->commands();
    pump_ = std::thread([this] {
      for (tracking::Sample sample; !quit_;)
        if (session_->ready(10ms) && !session_->next(sample)) return;
    });
    ASSERT_TRUE(eventually(10s, [this] { return session_->sides().front().received > 100; }));
  }
  void TearDown() override {
    endSession();
    std::filesystem::remove(log_);
  }
  virtual void change(LiveSetup&) {}

  void endSession() {
    quit_ = true;
    if (pump_.joinable()) pump_.join();
    session_.reset();
  }
  static bool eventually(Clock::duration patience, const std::function<bool()>& done) {
    for (const auto end = Clock::now() + patience; Clock::now() < end; std::this_thread::sleep_for(2ms))
      if (done()) return true;
    return false;
  }
  /// Arms, and waits until the robot listens.
  void arm() {
    if (state() == DriveState::kArmed || state() == DriveState::kMoving) return;
    commander_->arm();
    ASSERT_TRUE(eventually(5s, [this] { return state() == DriveState::kArmed; }))
        << commander_->status().reason;
    std::this_thread::sleep_for(500ms);
  }
  /// Holds the dead-man's key until `done`, as a window does that renews it; true: it became so.
  bool holdUntil(Clock::duration patience, const std::function<bool()>& done) {
    const auto end = Clock::now() + patience;
    while (!done()) {
      if (Clock::now() > end) return false;
      commander_->hold();
      std::this_thread::sleep_for(10ms);
    }
    return true;
  }
  void holdFor(Clock::duration time) {
    holdUntil(time, [] { return false; });
  }
  /// Drives for at least `time` without a stop, or until the arm has arrived. A busy computer stops it by a
  /// silence of the motors: then it is armed again, as a person would.
  void drive(Clock::duration time) {
    for (int trial = 0; trial < 100; ++trial) {
      const auto begin = Clock::now();
      const bool stopped = holdUntil(time, [this] { return state() == DriveState::kStopped; });
      held_seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
      if (!stopped && state() == DriveState::kMoving) return;
      if (commander_->status().reason != kSilence) return;
      ASSERT_NO_FATAL_FAILURE(arm());
    }
    FAIL() << "this computer is too busy";
  }
  static constexpr const char* kSilence = "no motor positions for 0.1 s";
  DriveState state() const { return commander_->status().state; }

  /// Whether anybody publishes set-points, by the master.
  static bool isAdvertised() {
    const auto topics = ros1::topicsAtMaster(ros1::masterUri(), 2s);
    return topics && std::ranges::any_of(*topics, [](const auto& t) { return t.topic == "/arm/servo_jp"; });
  }
  struct Command {
    double time = 0.0;  ///< of arrival at the robot [s, monotonic clock]
    std::vector<double> positions;
  };
  std::vector<Command> commands() const {
    std::vector<Command> all;
    std::ifstream file(log_);
    for (std::string line; std::getline(file, line);) {
      std::istringstream cells(line);
      Command& command = all.emplace_back();
      cells >> command.time;
      for (double x = 0.0; cells >> x;) command.positions.push_back(x);
    }
    return all;
  }
  static double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }
  /// Fails if the robot gets anything later than 50 ms after `stopped`.
  void expectSilenceAfter(double stopped) const {
    std::this_thread::sleep_for(400ms);
    ASSERT_FALSE(commands().empty());
    EXPECT_LT(commands().back().time - stopped, 0.05);
  }

  const std::filesystem::path log_ =
      std::filesystem::temp_directory_path() / ("capstan_servo_" + std::to_string(getpid()));
  std::optional<Process> master_, robot_;
  std::unique_ptr<LiveSource> session_;
  std::shared_ptr<RobotCommands> commander_;
  double held_seconds_ = 0.0;  ///< the key, in drive()
  std::atomic<bool> quit_ = false;
  std::thread pump_;
};

TEST_F(CommandedRobot, GetsNothingBeforeItIsArmedAndNothingAfterTheKeyIsReleased) {
  holdFor(500ms);
  EXPECT_TRUE(commands().empty()) << "the key alone";
  EXPECT_FALSE(isAdvertised());
  ASSERT_NO_FATAL_FAILURE(arm());
  std::this_thread::sleep_for(500ms);
  EXPECT_TRUE(commands().empty()) << "armed, and the key is not held";
  EXPECT_TRUE(isAdvertised());

  ASSERT_NO_FATAL_FAILURE(drive(500ms));
  EXPECT_EQ(state(), DriveState::kMoving) << commander_->status().reason;
  commander_->release();
  ASSERT_NO_FATAL_FAILURE(expectSilenceAfter(now()));
  EXPECT_NE(state(), DriveState::kMoving);
  const auto first = commands();
  EXPECT_GT(first.size(), 30U) << "100 a second";
  EXPECT_EQ(commander_->status().published, first.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    ASSERT_EQ(first[k].positions.size(), 6U);
    EXPECT_EQ(first[k].positions[0], testing::kServoWrist[0]) << "the joints that are not driven stay";
    EXPECT_EQ(first[k].positions[2], testing::kServoWrist[1]);
    EXPECT_EQ(first[k].positions[5], testing::kServoWrist[2]);
    const double yaw = first[k].positions[kServoPlaces[0]] - kServoOffsets[0];
    EXPECT_LE(yaw, testing::kServoStart[0] + 1e-6);
    EXPECT_GE(yaw, testing::kServoStart[0] - 0.2 * held_seconds_) << "faster than its speed";
  }

  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(200ms));
  commander_->stop(DriveStop::kByHand);
  const double stopped = now();
  holdFor(300ms);
  ASSERT_NO_FATAL_FAILURE(expectSilenceAfter(stopped));
  EXPECT_EQ(state(), DriveState::kStopped);
  EXPECT_EQ(commander_->status().reason, "stopped by hand");
  EXPECT_FALSE(isAdvertised());
}

TEST_F(CommandedRobot, ComesToRestAtTheHardStop) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(60s));
  ASSERT_EQ(commander_->status().reason, "the arm is at the hard stop");
  ASSERT_FALSE(commands().empty());
  const Eigen::Vector3d stop = robot::homingOf(robot::defaultDescription());
  const auto last = commands().back().positions;
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(last[kServoPlaces[k]], kServoSigns[k] * stop[static_cast<Eigen::Index>(k)] + kServoOffsets[k],
                1e-8);
}

TEST_F(CommandedRobot, StopsWhenItsMotorsFallSilent) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(200ms));
  ASSERT_EQ(state(), DriveState::kMoving) << commander_->status().reason;
  robot_->send(SIGSTOP);
  const auto begin = Clock::now();
  ASSERT_TRUE(holdUntil(2s, [this] { return state() == DriveState::kStopped; }));
  EXPECT_LT(Clock::now() - begin, 500ms) << "0.1 s, and what a busy computer needs";
  EXPECT_EQ(commander_->status().reason, kSilence);
  const auto published = commander_->status().published;
  holdFor(300ms);
  EXPECT_EQ(commander_->status().published, published);
  robot_->send(SIGCONT);
}

TEST_F(CommandedRobot, GetsNothingAfterTheSession) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(200ms));
  const std::size_t before = commands().size();
  EXPECT_GT(before, 10U);
  endSession();
  const double ended = now();
  EXPECT_EQ(state(), DriveState::kStopped);
  holdFor(300ms);
  ASSERT_NO_FATAL_FAILURE(expectSilenceAfter(ended));
}

class DrivenByGoals : public CommandedRobot {
  void change(LiveSetup& setup) override {
    setup.commands->move_jp = "/arm/move_jp";
    setup.commands->servo_jp.clear();
  }
};

TEST_F(DrivenByGoals, GetsTwentyASecondAndComesToRestAtTheHardStop) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(500ms));
  commander_->release();
  ASSERT_NO_FATAL_FAILURE(expectSilenceAfter(now()));
  EXPECT_LE(commands().size(), 1 + static_cast<std::size_t>(held_seconds_ / 0.05));
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(60s));
  EXPECT_EQ(commander_->status().reason, "the arm is at the hard stop");
  EXPECT_EQ(commander_->status().topic, "/arm/move_jp");
}

class WrongSign : public CommandedRobot {
  void change(LiveSetup& setup) override { setup.commands->signs[1] = 1.0; }
};

TEST_F(WrongSign, IsNeverMoved) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(2s));
  EXPECT_NE(commander_->status().reason.find("pitch"), std::string::npos) << commander_->status().reason;
  EXPECT_TRUE(commands().empty());
}

class NobodyListens : public CommandedRobot {
  void change(LiveSetup& setup) override { setup.commands->servo_jp = "/other/servo_jp"; }
};

TEST_F(NobodyListens, IsSaid) {
  ASSERT_NO_FATAL_FAILURE(arm());
  ASSERT_NO_FATAL_FAILURE(drive(2s));
  EXPECT_NE(commander_->status().reason.find("no robot listens to /other/servo_jp"), std::string::npos);
}

TEST(CommandsOfASetup, AreChecked) {
  const auto faultOf = [](const std::string& commands) {
    return refusedKey("title: mine\nmotors:\n  from: tcp://127.0.0.1:5555\ncommands:\n" + commands);
  };
  EXPECT_EQ(faultOf("  servo_jp: /arm/servo_jp\n"), "");
  EXPECT_EQ(faultOf("  move_jp: /arm/move_jp\n  speed: [0.1, 0.1, 0.01]\n"), "");
  EXPECT_EQ(faultOf("  measured: /arm/measured_js\n"), "commands.servo_jp");
  EXPECT_EQ(faultOf("  servo_jp: /a\n  move_jp: /b\n"), "commands.servo_jp");
  EXPECT_EQ(faultOf("  servo_jp: arm/servo_jp\n"), "commands.servo_jp");
  EXPECT_EQ(faultOf("  servo_jp: /a\n  signs: [1, 0.5, 1]\n"), "commands.signs");
  EXPECT_EQ(faultOf("  servo_jp: /a\n  speed: [0.1, 0.1, 5]\n"), "commands.speed[2]");
  EXPECT_EQ(faultOf("  servo_jp: /a\n  names: [one]\n"), "commands.names");
}

}  // namespace
}  // namespace capstan::live
