/// Rows over real connections of this computer.
#include "core/live/live_source.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/live/cameras/image_server.h"
#include "core/live/player.h"
#include "core/live/runner.h"
#include "core/live/streams/tcp_sender.h"
#include "core/recording/table_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/side_text.h"
#include "tests/core/live/setup_fault.h"
#include "tests/support/folders.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;
using State = tracking::SideStatus::State;

recording::MeasuredTable movingTable(int rows, double begin = 0.0) {
  recording::MeasuredTable table;
  table.file = "moving";
  table.q_m.resize(3), table.q.resize(3), table.p_c.resize(3);
  const robot::Description raven = robot::readDescriptionOrDefault({});
  for (int k = 0; k < rows; ++k) {
    const double t = 1e-3 * k;
    table.t.push_back(begin + t);
    const double at[] = {80.0 + std::sin(t), -90.0 + std::cos(t), -480.0 + t};
    for (std::size_t joint = 0; joint < 3; ++joint) {
      table.q_m[joint].push_back(at[joint]);
      table.q[joint].push_back(joint == 2 ? 0.34 : 1.0 + 0.01 * t);
      table.p_c[joint].push_back(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return table;
}

LiveSetup listening() { return liveSetupOf("tcp://127.0.0.1:0", {}, {}); }

Address addressOf(const LiveSource& source) { return parseAddress(source.sides().front().from, "address"); }
std::unique_ptr<TcpSender> receiverAt(const Address& address) { return std::make_unique<TcpSender>(address); }

/// Waits until `done` or 5 s have passed.
template <class Done>
bool eventually(const Done& done) {
  for (int k = 0; k < 500; ++k) {
    if (done()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

const PlayClock kAtOnce{.begin = 0.0, .speed = 0.0};

TEST(LiveSource, GivesTheSamplesOfATable) {
  const recording::MeasuredTable table = movingTable(500);
  LiveSource source(listening());
  EXPECT_FALSE(source.ready(10ms));
  const PlayReport report = playRows(table, receiverAt(addressOf(source)), kAtOnce, {}, nullptr);
  EXPECT_EQ(report.sent, 500U);
  recording::TableSource direct(table, source.info().robot);
  tracking::Sample live, recorded;
  while (direct.next(recorded)) {
    ASSERT_TRUE(source.ready(2s));
    ASSERT_TRUE(source.next(live));
    ASSERT_EQ(live.index(), recorded.index());
    if (const auto* motor = std::get_if<tracking::MotorSample>(&live)) {
      EXPECT_EQ(motor->t, std::get<tracking::MotorSample>(recorded).t);
      EXPECT_EQ(motor->position, std::get<tracking::MotorSample>(recorded).position);
    }
  }
  EXPECT_FALSE(source.ready(0ms));
  const tracking::SideStatus status = source.sides().front();
  EXPECT_EQ(status.received, 500U);
  EXPECT_EQ(status.dropped, 0U);
  ASSERT_TRUE(status.latency);
  EXPECT_GT(status.latency->median, 0.0);
  EXPECT_LE(status.latency->median, status.latency->p99);
}

TEST(LiveSource, NamesASilentSideAndTakesItBack) {
  LiveSource source(listening());
  EXPECT_EQ(source.sides().front().state, State::kWaiting);
  {
    TcpSender robot(addressOf(source));
    robot.send(formatMeasuredTable(movingTable(100)));
    ASSERT_TRUE(eventually([&] { return source.sides().front().state == State::kReceiving; }));
    ASSERT_TRUE(eventually([&] { return source.sides().front().state == State::kSilent; }));
    EXPECT_NEAR(source.sides().front().silent_for, tracking::SideStatus::kSilence, 0.1);
    EXPECT_NE(tracking::shortTextOf(source.sides().front()).find("motors silent for 0.4 s"),
              std::string::npos);
  }
  ASSERT_TRUE(eventually([&] { return source.sides().front().state == State::kWaiting; }));
  TcpSender again(addressOf(source));
  again.send(formatMeasuredTable(movingTable(100, 1e9)));
  ASSERT_TRUE(eventually([&] { return source.sides().front().received == 200; }));
  EXPECT_EQ(source.sides().front().connections, 2U);
  double last = -1.0;
  tracking::Sample sample;
  while (source.ready(0ms) && source.next(sample)) {
    const auto* motor = std::get_if<tracking::MotorSample>(&sample);
    if (!motor) continue;
    EXPECT_GT(motor->t, last);
    last = motor->t;
  }
  EXPECT_LT(last, 10.0) << "the session's clock goes on, whatever the robot's says";
}

TEST(LiveSource, RefusesAStrangerWithTheReason) {
  LiveSource source(listening());
  TcpSender stranger(addressOf(source));
  stranger.send("GET / HTTP/1.1\r\nHost: robot\r\n\r\n" + std::string(100, '\n'));
  std::string answer;
  ASSERT_TRUE(eventually([&] { return !(answer = stranger.answer()).empty(); }));
  EXPECT_NE(answer.find("error: "), std::string::npos) << answer;
  EXPECT_EQ(source.sides().front().state, State::kRefused);
  EXPECT_TRUE(tracking::needsAttention(source.sides().front()));
  EXPECT_NE(tracking::shortTextOf(source.sides().front()).find("refused"), std::string::npos);
  playRows(movingTable(100), receiverAt(addressOf(source)), kAtOnce, {}, nullptr);
  EXPECT_TRUE(eventually([&] { return source.sides().front().received == 100; }))
      << "the robot may still come";
}

TEST(LiveSource, TellsASecondProgramThatAnotherIsConnected) {
  LiveSource source(listening());
  TcpSender robot(addressOf(source));
  robot.send(formatMeasuredTable(movingTable(100)));
  ASSERT_TRUE(eventually([&] { return source.sides().front().received == 100; }));
  TcpSender second(addressOf(source));
  std::string answer;
  ASSERT_TRUE(eventually([&] { return !(answer = second.answer()).empty(); }));
  EXPECT_NE(answer.find("another program sends its rows here. End it first"), std::string::npos) << answer;
  EXPECT_EQ(source.sides().front().connections, 1U);
}

/// A program that connects and says nothing holds the place for 2 s at most when another one comes.
TEST(LiveSource, ASilentStrangerGivesWayToTheRobot) {
  LiveSource source(listening());
  TcpSender stranger(addressOf(source));
  ASSERT_TRUE(eventually([&] { return source.sides().front().connected; }));
  EXPECT_NE(tracking::shortTextOf(source.sides().front()).find("no valid row yet"), std::string::npos);
  const auto begin = std::chrono::steady_clock::now();
  TcpSender robot(addressOf(source));
  robot.send(formatMeasuredTable(movingTable(100)));
  ASSERT_TRUE(eventually([&] { return source.sides().front().received == 100; }));
  const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GT(waited, 1.5);
  EXPECT_LT(waited, 3.0);
  EXPECT_EQ(stranger.answer(), "error: no valid row for 2 s, and another program has come\n");
  EXPECT_EQ(robot.answer(), "");
  const tracking::SideStatus status = source.sides().front();
  EXPECT_EQ(status.state, State::kReceiving);
  EXPECT_EQ(status.connections, 2U);
  EXPECT_EQ(status.refused, 1U);
  EXPECT_NE(tracking::textOf(status).find("a program without a valid row for 2 s gave way to another one"),
            std::string::npos)
      << tracking::textOf(status);
}

/// Also one that sent rows and then fell silent, as a computer that was switched off; not before 2 s.
TEST(LiveSource, ARobotThatFellSilentGivesWayToItsSuccessor) {
  LiveSource source(listening());
  TcpSender before(addressOf(source));
  before.send(formatMeasuredTable(movingTable(100)));
  ASSERT_TRUE(eventually([&] { return source.sides().front().received == 100; }));
  {
    TcpSender early(addressOf(source));
    std::string answer;
    ASSERT_TRUE(eventually([&] { return !(answer = early.answer()).empty(); }));
    EXPECT_NE(answer.find("another program sends its rows here"), std::string::npos) << answer;
  }
  std::this_thread::sleep_for(2100ms);
  EXPECT_EQ(source.sides().front().refused, 0U) << "nobody has come";
  TcpSender after(addressOf(source));
  after.send(formatMeasuredTable(movingTable(100)));
  ASSERT_TRUE(eventually([&] { return source.sides().front().received == 200; }));
  EXPECT_EQ(source.sides().front().refused, 1U);
}

/// Bytes that never become a row are no rows.
TEST(LiveSource, AStrangerThatDripsBytesGivesWay) {
  LiveSource source(listening());
  TcpSender stranger(addressOf(source));
  ASSERT_TRUE(eventually([&] { return source.sides().front().connected; }));
  TcpSender robot(addressOf(source));
  robot.send(formatMeasuredTable(movingTable(100)));
  ASSERT_TRUE(eventually([&] {
    stranger.send("t,");
    return source.sides().front().received == 100;
  }));
}

TEST(LiveSource, AnswersAWrongFirstLineWhileItsSenderWaits) {
  for (const char* line : {"hello robot\n", "t,q1,q2,q3\n", "t,q_m1,q_m2,q_m3\n0,80,oops,-480\n"}) {
    LiveSource source(listening());
    TcpSender robot(addressOf(source));
    const auto begin = std::chrono::steady_clock::now();
    robot.send(line);
    std::string answer;
    ASSERT_TRUE(eventually([&] { return !(answer = robot.answer()).empty(); })) << line;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 500ms) << line;
    EXPECT_TRUE(answer.starts_with("error: ")) << answer;
  }
}

/// A program that is killed while it sends `…,-480.25`.
TEST(LiveSource, ARowThatTheEndOfTheConnectionCutsOffIsExcludedAndCounted) {
  LiveSource source(listening());
  TcpSender(addressOf(source)).send(formatMeasuredTable(movingTable(100)) + "0.1,80,-90,-4");
  ASSERT_TRUE(eventually([&] { return source.sides().front().incomplete == 1; }));
  EXPECT_EQ(source.sides().front().received, 100U);
  EXPECT_THAT(tracking::textOf(source.sides().front()), testing::HasSubstr("1 row incomplete"));
}

TEST(LiveSource, ReadsAFifoOfSeveralWriters) {
  const auto path = std::filesystem::temp_directory_path() / ("capstan_fifo_" + std::to_string(getpid()));
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  {
    LiveSource source(liveSetupOf(path.string(), {}, {}));
    for (std::uint64_t writer = 1; writer <= 2; ++writer) {
      std::ofstream(path) << formatMeasuredTable(movingTable(100, 10.0 * static_cast<double>(writer)));
      ASSERT_TRUE(eventually([&] { return source.sides().front().received == 100 * writer; }));
      ASSERT_TRUE(eventually([&] { return source.sides().front().state == State::kWaiting; }));
    }
  }
  std::filesystem::remove(path);
}

TEST(LiveSource, ArrangesMotorsAndSigns) {
  LiveSetup setup = listening();
  setup.motors.motors = {2, 1, 3};
  setup.motors.signs = {-1.0, 1.0, -1.0};
  LiveSource source(setup);
  // A robot whose first two motors are exchanged, and two of which count the other way.
  recording::MeasuredTable table = movingTable(60);
  std::swap(table.q_m[0], table.q_m[1]);
  for (const std::size_t column : {1U, 2U})
    for (double& position : table.q_m[column]) position = -position;
  playRows(table, receiverAt(addressOf(source)), kAtOnce, {}, nullptr);
  tracking::Sample sample;
  ASSERT_TRUE(source.ready(2s));
  ASSERT_TRUE(source.next(sample));
  EXPECT_EQ(std::get<tracking::MotorSample>(sample).position,
            Eigen::Vector3d(-table.q_m[1][0], table.q_m[0][0], -table.q_m[2][0]));
}

/// Without cameras and encoders nothing else would name it.
TEST(LiveSource, RefusesAWrongOrderOfMotors) {
  LiveSetup setup = listening();
  setup.motors.motors = {2, 1, 3};
  LiveSource source(setup);
  TcpSender robot(addressOf(source));
  robot.send(formatMeasuredTable(movingTable(100)));
  std::string answer;
  ASSERT_TRUE(eventually([&] { return !(answer = robot.answer()).empty(); }));
  EXPECT_THAT(answer, testing::HasSubstr("outside its limits"));
  const tracking::SideStatus status = source.sides().front();
  EXPECT_EQ(status.state, State::kRefused);
  EXPECT_EQ(status.received, 0U);
  EXPECT_THAT(tracking::textOf(status), testing::HasSubstr("Check motors"));
}

/// The set-up decides whether columns q are joint encoders.
TEST(LiveSource, ColumnsThatAreNoReferenceAreNotUsed) {
  for (const bool reference : {true, false}) {
    LiveSetup setup = listening();
    setup.motors.reference = reference;
    LiveSource source(setup);
    EXPECT_EQ(source.info().reference, reference);
    playRows(movingTable(100), receiverAt(addressOf(source)), kAtOnce, {}, nullptr);
    ASSERT_TRUE(eventually([&] { return source.sides().front().received == 100; }));
    int motors = 0, joints = 0;
    for (tracking::Sample sample; source.ready(0ms) && source.next(sample);) {
      motors += std::holds_alternative<tracking::MotorSample>(sample) ? 1 : 0;
      joints += std::holds_alternative<tracking::JointSample>(sample) ? 1 : 0;
    }
    EXPECT_EQ(motors, 100);
    EXPECT_EQ(joints, reference ? 100 : 0);
  }
}

/// A runner paces recordings, but takes live samples as they come; commands do not wait for them.
TEST(LiveSource, RunsInARunner) {
  auto source = std::make_unique<LiveSource>(listening());
  const Address address = addressOf(*source);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(source->info(), {});
  Runner runner(std::move(source), std::move(pipeline));
  runner.run();
  std::promise<void> executed;
  runner.post([&](tracking::Source&, tracking::TrackingPipeline&) { executed.set_value(); });
  EXPECT_EQ(executed.get_future().wait_for(2s), std::future_status::ready) << "while nothing comes";
  playRows(movingTable(300), receiverAt(address), kAtOnce, {}, nullptr);
  ASSERT_TRUE(eventually([&] { return runner.report().motor_samples == 300; }));
  ASSERT_TRUE(eventually([&] {
    const auto sides = runner.status().sides;
    return sides.size() == 1 && sides.front().received == 300;
  }));
}

/// Two network cameras, of which the left one gives the same image again and again while it is blocked.
TEST(LiveSource, ACameraThatIsBlockedIsStillRecognisedAsFrozen) {
  ImageServer server("127.0.0.1", 0);
  LiveSetup setup = listening();
  const std::string at = "http://127.0.0.1:" + std::to_string(server.port());
  setup.cameras.emplace();
  setup.cameras->left = at + "/left", setup.cameras->right = at + "/right";
  setup.cameras->calibration = test::sourceFile("resources/cameras").string();
  LiveSource source(setup);
  playRows(movingTable(100), receiverAt(addressOf(source)), kAtOnce, {}, nullptr);
  cv::Mat frozen(48, 64, CV_8UC3), image(48, 64, CV_8UC3);
  cv::randu(frozen, 0, 255);
  int frames = 0, covered = 0;
  source.block(true, false);
  // Until pairs have come, the left image changes.
  const bool recognised = eventually([&] {
    cv::randu(image, 0, 255);
    server.publish(frames < 5 ? image : frozen, image.clone());
    // What is passed on is covered before the next image comes.
    for (tracking::Sample sample; source.ready(100ms) && source.next(sample);)
      if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) {
        ++frames;
        cv::Scalar mean, spread;
        cv::meanStdDev(frame->left, mean, spread);
        covered += frame->blocked[0] && spread[0] < 10.0;  // noise has 74
      }
    return source.sides().back().state == State::kFrozen;
  });
  EXPECT_TRUE(recognised) << tracking::textOf(source.sides().back());
  EXPECT_EQ(source.sides().back().part, "left");
  EXPECT_GE(frames, 5);
  EXPECT_LE(frames, 8) << "one frozen pair, and what was under way";
  EXPECT_EQ(covered, frames);
}

TEST(LiveSetup, FilesAreChecked) {
  const LiveSetup shown = readLiveSetup(test::sourceFile("resources/live/rows_over_tcp.yaml"));
  EXPECT_EQ(shown.motors.from, "tcp://127.0.0.1:5555");
  const LiveSetup cameras = readLiveSetup(test::sourceFile("resources/live/rows_and_cameras.yaml"));
  ASSERT_TRUE(cameras.cameras);
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(cameras.cameras->calibration) / "left.yaml"));
  const auto faultOf = [](const std::string& motors) {
    return refusedKey("title: mine\nmotors:\n" + motors);
  };
  EXPECT_EQ(faultOf("  from: tcp://127.0.0.1:5555\n"), "");
  EXPECT_EQ(faultOf("  from: tcp://nowhere\n"), "motors.from");
  EXPECT_EQ(faultOf("  from: \"-\"\n  motors: [1, 1, 2]\n"), "motors.motors");
  EXPECT_EQ(faultOf("  from: \"-\"\n  signs: [1, 0.5, 1]\n"), "motors.signs");
  EXPECT_EQ(faultOf("  from: \"-\"\n  read_as: q_m=parsec\n"), "motors.read_as");
  EXPECT_EQ(faultOf("  from: \"-\"\ncameras:\n  left: /dev/video0\n  calibration: .\n"), "cameras.right");
  EXPECT_EQ(faultOf("  form: \"-\"\n"), "motors.form");
}

TEST(LiveSetup, AFaultNamesTheLineOfTheSetUp) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "setup.yaml";
  base::writeTextFile(folder / "bad.yaml", "name: bad\n");
  const auto faultOf = [&](const std::string& text) {
    base::writeTextFile(path, "title: mine\n" + text);
    try {
      liveSetupOf(path, {}, {});
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().file, path) << error.what();
      return error.fault();
    }
    return base::InputFault{};
  };
  const std::string motors = "motors:\n  from: \"-\"\n", cameras = "cameras:\n  left: a\n  right: b\n";
  EXPECT_EQ(faultOf(motors + "  signs: [1, 0.5, 1]\n").line, 4);
  const base::InputFault missing = faultOf("robot: nowhere.yaml\n" + motors);
  EXPECT_EQ(missing.line, 2);
  EXPECT_EQ(missing.key, "robot");
  EXPECT_THAT(missing.value, testing::HasSubstr("nowhere.yaml"));
  EXPECT_THAT(missing.remedy, testing::HasSubstr("cannot be opened"));
  const base::InputFault bad = faultOf(motors + "robot: bad.yaml\n");
  EXPECT_EQ(bad.line, 4);
  EXPECT_THAT(bad.remedy, testing::HasSubstr("bad.yaml:1: ")) << "the place in the robot file, too";
  EXPECT_EQ(faultOf(motors + cameras).key, "cameras.calibration") << "missing";
  const base::InputFault calibration = faultOf(motors + cameras + "  calibration: nowhere\n");
  EXPECT_EQ(calibration.line, 7);
  EXPECT_EQ(calibration.key, "cameras.calibration");
  const std::string rig = "  calibration: " + test::sourceFile("resources/cameras").string() + "\n";
  EXPECT_EQ(faultOf(motors + cameras + rig + "  registration: nowhere.yaml\n").line, 8);
  EXPECT_EQ(faultOf(motors + cameras + rig + "  marker: nowhere.yaml\n").key, "cameras.marker");
}

}  // namespace
}  // namespace capstan::live
