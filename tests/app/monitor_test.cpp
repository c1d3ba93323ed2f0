// The real capstan-monitor: arguments, pixels of every layout, sessions that come and go.
#include <opencv2/core.hpp>

#include "core/live/feed/feed_writer.h"
#include "tests/app/monitor_fixture.h"

namespace capstan::testing {
namespace {

TEST_F(MonitorProgram, UsageErrorsAreExitTwoWithoutADisplay) {
  const std::string program = "env -u DISPLAY " + monitor_;
  const Ran help = runShell(program + " --help");
  EXPECT_EQ(help.exit, 0);
  for (const char* option : {"--feed", "--layout", "--full-screen", "--display", "--report", "interleaved"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  const Ran version = runShell(program + " --version");
  EXPECT_EQ(version.exit, 0);
  for (const char* text : {"capstan-monitor ", "\nOpenCV ", "\nGLFW "})
    EXPECT_NE(version.out.find(text), std::string::npos) << version.out;
  for (const char* wrong : {"--no-such-option", "--layout sideways", "--size 10x10", "--display 0",
                            "--duration nan", "--frames 0", "--feed a/b", "--feed ''"})
    EXPECT_EQ(runShell(program + " " + wrong).exit, 2) << wrong;
  const Ran none = runShell(program);
  EXPECT_EQ(none.exit, 2);
  EXPECT_NE(none.err.find("no display"), std::string::npos) << none.err;
}

TEST_F(MonitorProgram, NamesTheDisplaysAndRefusesOthers) {
  const Ran list = onDisplay("$monitor --list-displays; $monitor --display 9");
  EXPECT_EQ(list.exit, 2);
  EXPECT_NE(list.out.find("1280 x 720"), std::string::npos) << list.out;
  EXPECT_NE(list.err.find("--display = 9"), std::string::npos) << list.err;
}

/// Colour B, G, R of a pixel.
cv::Vec3b at(const cv::Mat& picture, int x, int y) { return picture.at<cv::Vec3b>(y, x); }

void expectNear(const cv::Vec3b& actual, const cv::Vec3b& expected, const char* where) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 2) << where << ", channel " << i;
}

/// Both eyes of one colour each, so that every layout's pixels are known.
TEST_F(MonitorProgram, DrawsTheEyesWhereTheLayoutHasThem) {
  const cv::Vec3b left(20, 60, 200), right(180, 120, 40);
  live::FeedWriter writer(feed_);
  live::FeedState state;
  state.tracking = live::FeedTracking::kTracking;
  writer.publish(state, cv::Mat(480, 640, CV_8UC3, cv::Scalar(left)),
                 cv::Mat(480, 640, CV_8UC3, cv::Scalar(right)));
  const Ran ran = onDisplay(
      "for l in side-by-side top-bottom interleaved anaglyph left right; do\n"
      "  $monitor --feed $feed --layout $l --frames 1 --screenshot $l.png || exit 1\ndone\n"
      "$monitor --feed $feed --swap --frames 1 --screenshot swapped.png\n"
      "$monitor --feed $feed --layout left --stretch --frames 1 --screenshot stretched.png");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const cv::Vec3b black(0, 0, 0), bar(0x73, 0x9E, 0x00);

  const cv::Mat beside = picture("side-by-side.png");
  expectNear(at(beside, 320, 340), left, "left half");
  expectNear(at(beside, 960, 340), right, "right half");
  expectNear(at(beside, 320, 30), black, "above the image, which keeps its shape");
  expectNear(at(beside, 630, 716), bar, "bar of the state");
  const cv::Mat swapped = picture("swapped.png");
  expectNear(at(swapped, 320, 340), right, "swapped");

  const cv::Mat below = picture("top-bottom.png");
  expectNear(at(below, 640, 160), left, "top");
  expectNear(at(below, 640, 520), right, "bottom");

  expectNear(at(picture("left.png"), 640, 320), left, "left alone");
  expectNear(at(picture("right.png"), 640, 320), right, "right alone");
  expectNear(at(picture("left.png"), 20, 320), black, "beside the image");
  expectNear(at(picture("stretched.png"), 20, 320), left, "stretched");

  const cv::Mat rows = picture("interleaved.png");
  for (int y = 100; y < 120; ++y) expectNear(at(rows, 640, y), y % 2 == 0 ? left : right, "rows");

  const auto grey = [](const cv::Vec3b& c) {  // ITU-R BT.601
    return static_cast<unsigned char>(0.114 * c[0] + 0.587 * c[1] + 0.299 * c[2] + 0.5);
  };
  expectNear(at(picture("anaglyph.png"), 640, 320), {grey(right), grey(right), grey(left)}, "red and cyan");
}

TEST_F(MonitorProgram, KeysChangeWhatIsShown) {
  const cv::Vec3b left(20, 60, 200), right(180, 120, 40);
  live::FeedWriter writer(feed_);
  live::FeedState state;
  writer.publish(state, cv::Mat(480, 640, CV_8UC3, cv::Scalar(left)),
                 cv::Mat(480, 640, CV_8UC3, cv::Scalar(right)));
  const Ran ran = onDisplay(
      "press() {\n  $monitor --feed $feed --duration 60 --screenshot $1.png & running=$!\n  shift\n"
      "  timeout 30 xdotool search --sync --name 'Capstan stereo monitor' >window.txt\n  sleep 0.3\n"
      "  for key; do xdotool key --window $(head -1 window.txt) $key; done\n  wait $running || exit 1\n}\n"
      "press left 5 q\npress swapped 5 s q\npress filled 2 5 a q\npress numbers 5 n q\n"
      "press help 5 F1 Escape");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  expectNear(at(picture("left.png"), 640, 320), left, "5");
  expectNear(at(picture("left.png"), 20, 320), {0, 0, 0}, "5");
  expectNear(at(picture("swapped.png"), 640, 320), right, "S");
  expectNear(at(picture("filled.png"), 20, 320), left, "A");
  const auto changed = [&](const char* name) {
    cv::Mat difference;
    cv::absdiff(picture("left.png"), picture(name), difference);
    return cv::mean(difference)[2];
  };
  EXPECT_GT(changed("numbers.png"), 5.0);
  EXPECT_GT(changed("help.png"), 5.0);
}

TEST_F(MonitorProgram, ShowsARunningSessionAndReportsItsLatency) {
  const Ran ran = onDisplay(
      "$monitor --feed $feed --frames 20 --duration 60 --report before.json & before=$!\n"  // before it
      "$session --feed $feed --seconds 8 >session.json & session=$!\n"
      "sleep 2\n"
      "$monitor --feed $feed --frames 10 --duration 60 --numbers --latency --screenshot shown.png "
      "--report late.json\n"
      "wait $before && wait $session");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json early = report("before.json"), late = report("late.json");
  EXPECT_EQ(early["images"], 20);
  EXPECT_EQ(late["images"], 10);
  EXPECT_EQ(late["latency_ms"]["count"], 10);
  EXPECT_GT(late["latency_ms"]["median"], 0.0);
  EXPECT_GE(late["latency_ms"]["p99"], late["latency_ms"]["median"]);
  EXPECT_EQ(late["sessions"], 1);
  EXPECT_EQ(report("session.json")["error"], "");
  EXPECT_GT(cv::mean(picture("shown.png"))[2], 20.0) << "it is not black";
}

TEST_F(MonitorProgram, MonitorsThatAreKilledDoNotDisturbTheSession) {
  const Ran ran = onDisplay(
      "$session --feed $feed --seconds 9 >session.json & session=$!\n"
      "for delay in 0.05 0.3 0.6 0.9 1.2; do\n"
      "  $monitor --feed $feed & killed=$!\n  sleep $delay; kill -9 $killed; wait $killed\ndone 2>/dev/null\n"
      "$monitor --feed $feed --frames 5 --duration 60 --report last.json\n"
      "wait $session");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(report("last.json")["images"], 5) << "a monitor after the killed ones";
  const json session = report("session.json");
  EXPECT_EQ(session["error"], "");
  EXPECT_GT(session["frames"], 100) << "of 135";
}

TEST_F(MonitorProgram, OutlivesAKilledSessionAndShowsTheNextOne) {
  const Ran ran = onDisplay(
      "$monitor --feed $feed --frames 60 --duration 60 --report monitor.json & monitor=$!\n"
      "$session --feed $feed --seconds 60 & killed=$!\n"
      "sleep 2.5; kill -9 $killed; wait $killed\n"
      "$session --feed $feed --seconds 60 >/dev/null & next=$!\n"
      "wait $monitor; result=$?\nkill -9 $next; wait $next; exit $result");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json monitor = report("monitor.json");
  EXPECT_EQ(monitor["images"], 60);
  EXPECT_EQ(monitor["sessions"], 2);
  const live::FeedWriter last(feed_);  // takes over what the killed session has left, and removes it
}

/// `play` is robot and cameras of another process.
TEST_F(MonitorProgram, ShowsASessionOfTheCommandLine) {
  simulate("trial.capstan", "--duration 4");
  ASSERT_EQ(run("track " + path("trial.capstan") + " --save-registration " + path("registration.yaml")).exit,
            0);
  const std::string port = std::to_string(20000 + getpid() % 20000),
                    video = "http://127.0.0.1:" + std::to_string(40000 + getpid() % 20000);
  write("live.yaml", "title: robot of a process\nmotors:\n  from: tcp://127.0.0.1:" + port +
                         "\ncameras:\n  left: " + video + "/left\n  right: " + video +
                         "/right\n  calibration: " + test::resourceFile("cameras").string() +
                         "\n  registration: registration.yaml\n  latency: 0\n");
  for (const std::string command : {"track", "record --out live.capstan"}) {
    fs::remove(path("done"));
    const Ran ran = onDisplay(
        "($cli " + command + " --live live.yaml --duration 3.5 --monitor-feed $feed; touch done) &\n" +
        "$monitor --feed $feed --frames 10 --duration 30 --report " + command.substr(0, 5) + ".json &\n" +
        "until $cli play trial.capstan --to tcp://127.0.0.1:" + port + " --video " + video +
        "; do sleep 0.1; [ -e done ] && break; done; wait");
    const json shown = report(command.substr(0, 5) + ".json");
    EXPECT_EQ(shown["images"], 10) << command << ": " << ran.err;
  }
}

}  // namespace
}  // namespace capstan::testing
