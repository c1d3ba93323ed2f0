// ROS 1: bags, and robots and cameras that publish topics. Without ROS the tests skip.
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>
#include <vector>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

class CliRos : public Cli {
 protected:
  /// True: the program has no ROS, or this computer no `tool` of it.
  bool lacks(const std::string& tool) const {
    std::ofstream(path("row.csv")) << "t,q_m1,q_m2,q_m3\n0,0,0,0\n0.001,0,0,0\n";
    return run("play " + path("row.csv") + " --to ros", "ROS_MASTER_URI=http://localhost:1 ")
                   .err.find("needs ROS 1") != std::string::npos ||
           runShell("command -v " + tool).exit != 0;
  }
  /// Numbers of a column of a CSV file.
  std::vector<double> columnOf(const std::string& name, const std::string& column) const {
    std::vector<double> numbers;
    std::istringstream lines(textOf(name));
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream header(line);
    int place = 0;
    while (std::getline(header, cell, ',') && cell != column) ++place;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      for (int k = 0; k <= place; ++k) std::getline(cells, cell, ',');
      numbers.push_back(std::stod(cell));
    }
    return numbers;
  }
  /// Cells of a CSV file; times in whole nanoseconds, the resolution of ROS.
  std::vector<std::string> cellsOf(const std::string& name) const {
    std::vector<std::string> cells;
    std::istringstream lines(textOf(name));
    for (std::string line; std::getline(lines, line);) {
      const std::size_t comma = line.find(',');
      const std::string t = line.substr(0, comma);
      cells.push_back(t == "t" ? t : std::to_string(std::llround(1e9 * std::stod(t))));
      cells.push_back(line.substr(comma));
    }
    return cells;
  }
};

TEST_F(CliRos, ABagHasTheNumbersOfItsSession) {
  if (lacks("rosbag")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --no-images --duration 3 --out " + path("a.capstan")).exit, 0);
  const Ran to = run("convert " + path("a.capstan") + " " + path("a.bag")),
            from = run("convert " + path("a.bag") + " " + path("b.capstan"));
  ASSERT_EQ(to.exit, 0) << to.err;
  ASSERT_EQ(from.exit, 0) << from.err;
  for (const char* file : {"a.capstan", "a.bag", "b.capstan"})
    ASSERT_EQ(run("convert " + path(file) + " " + path(std::string(file) + ".csv")).exit, 0);
  EXPECT_EQ(cellsOf("a.capstan.csv"), cellsOf("a.bag.csv"));
  EXPECT_EQ(cellsOf("a.capstan.csv"), cellsOf("b.capstan.csv"));
  const Ran info = runShell("rosbag info " + path("a.bag"));
  EXPECT_EQ(info.exit, 0) << info.err;
  EXPECT_NE(info.out.find("/arm/actuators/measured_js"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("sensor_msgs/JointState"), std::string::npos) << info.out;
}

TEST_F(CliRos, ImagesOfABagAreThoseOfItsSession) {
  if (lacks("rosbag")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --duration 1 --out " + path("a.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("a.capstan") + " " + path("a.bag")).exit, 0);
  ASSERT_EQ(run("track " + path("a.capstan") + " --out " + path("a.csv")).exit, 0);
  const Ran tracked = run("track " + path("a.bag") + " --out " + path("b.csv"));
  ASSERT_EQ(tracked.exit, 0) << tracked.err;
  EXPECT_EQ(cellsOf("a.csv").size(), cellsOf("b.csv").size());
}

TEST_F(CliRos, DamagedBagsAreRefused) {
  if (lacks("rosbag")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --no-images --duration 1 --out " + path("a.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("a.capstan") + " " + path("a.bag")).exit, 0);
  const std::string bytes = textOf("a.bag");
  for (const double share : {0.001, 0.3, 0.9, 0.999}) {
    std::ofstream(path("short.bag"), std::ios::binary)
        << bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
    const Ran ran = run("info " + path("short.bag"));
    EXPECT_EQ(ran.exit, 2) << share << ran.err;
    EXPECT_NE(ran.err.find("short.bag"), std::string::npos) << ran.err;
  }
  for (std::size_t k = 0; k < 40; ++k) {
    std::string flipped = bytes;
    flipped[(k * 7919 * 131) % bytes.size()] ^= static_cast<char>(1 << (k % 8));
    std::ofstream(path("flipped.bag"), std::ios::binary) << flipped;
    const Ran ran = run("convert " + path("flipped.bag") + " " + path("flipped.csv") + " --force");
    EXPECT_TRUE(ran.exit == 0 || ran.exit == 2) << k << ": " << ran.exit << ran.err;
  }
}

TEST_F(CliRos, WithoutMotorsABagIsRefusedWithItsTopics) {
  if (lacks("rosbag")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --no-images --duration 1 --out " + path("a.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("a.capstan") + " " + path("a.bag")).exit, 0);
  const Ran ran = run("track " + path("a.bag") + " --topics motors=/other/measured_js");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("/arm/actuators/measured_js"), std::string::npos) << ran.err;
}

/// A robot and its cameras publish in real time; a master of its own, on loopback; another program records
/// what the session publishes.
TEST_F(CliRos, ARobotThatPublishesTopicsIsTracked) {
  if (lacks("rosmaster")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --duration 9 --seed 3 --out " + path("trial.capstan")).exit, 0);
  const Ran direct = run("track " + path("trial.capstan") + " --save-registration " +
                         path("registration.yaml") + " --json -");
  ASSERT_EQ(direct.exit, 0) << direct.err;
  std::string setup = base::readTextFile(base::resource("live/ros.yaml").string());
  std::ofstream(path("ros.yaml")) << setup << "  registration: registration.yaml\n";
  const std::string port = std::to_string(20000 + getpid() % 20000), program = test::commandLineProgram();
  runShell("export ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:" + port +
           "; (rosmaster --core -p " + port + " & master=$!; sleep 1; " + program + " play " +
           path("trial.capstan") + " --to ros & " + program + " track --live " + path("ros.yaml") +
           " --publish /capstan --duration 8 --out " + path("live.csv") + " --json " + path("live.json") +
           " & tracking=$!; timeout 20 rosbag record -O " + path("out.bag") +
           " --duration 10 /capstan/measured_js /capstan/measured_cp; wait $tracking; " +
           "kill $master; wait) >/dev/null 2>&1");
  ASSERT_TRUE(fs::exists(path("live.json")));
  const json live = json::parse(textOf("live.json")), recorded = json::parse(direct.out);
  const json motors = live["live"][0], cameras = live["live"][1];
  EXPECT_EQ(motors["dropped"], 0);
  EXPECT_NEAR(motors["received"], 8000, 300);
  EXPECT_EQ(cameras["dropped"], 0);
  EXPECT_GT(live["camera_samples"], 80);
  EXPECT_GT(live["references"], 7500);
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(live["rms"]["ukf"][joint], recorded["rms"]["kin"][joint]) << joint;  // the cameras correct it

  const Ran published = run("convert " + path("out.bag") + " " + path("published.csv") +
                            " --topics motors=/capstan/measured_js");
  ASSERT_EQ(published.exit, 0) << published.err;
  const std::vector<double> sent = columnOf("published.csv", "q_m1"),
                            estimates = columnOf("live.csv", "q_ukf1");
  EXPECT_GT(sent.size(), 500u);
  const std::set<double> known(estimates.begin(), estimates.end());
  for (const double q : sent) ASSERT_TRUE(known.contains(q)) << q;
}

/// Debian's own `rosbag play` as the robot: every row and image of a bag that we wrote comes with its
/// numbers.
TEST_F(CliRos, ABagOfOursThatRosbagPlaysIsTrackedLive) {
  if (lacks("rosmaster") || lacks("rosbag")) GTEST_SKIP() << "ROS 1 is not installed";
  if (!fs::exists("/usr/lib/rosbag/play")) GTEST_SKIP() << "rosbag has no play";
  ASSERT_EQ(run("simulate --duration 4 --seed 5 --out " + path("a.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("a.capstan") + " " + path("a.bag")).exit, 0);
  ASSERT_EQ(run("track " + path("a.bag") + " --out " + path("direct.csv") + " --save-registration " +
                path("registration.yaml") + " --json " + path("direct.json"))
                .exit,
            0);
  std::ofstream(path("ros.yaml"))
      << "title: a bag, played\nmotors:\n  from: ros:/arm/actuators/measured_js\n"
         "  encoders: /arm/encoders/measured_js\ncameras:\n"
         "  left: ros:/stereo/left/image_raw\n  right: ros:/stereo/right/image_raw\n"
         "  registration: registration.yaml\n  calibration: "
      << base::resource("cameras").string() << '\n';
  const std::string port = std::to_string(20000 + getpid() % 20000), program = test::commandLineProgram();
  runShell("export ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:" + port +
           "; (rosmaster --core -p " + port + " & master=$!; sleep 1; rosbag play -q --queue=100000 -d 6 " +
           path("a.bag") + " & playing=$!; " + program + " track --live " + path("ros.yaml") + " --out " +
           path("live.csv") + " --json " + path("live.json") +
           " & tracking=$!; wait $playing; sleep 1; kill -INT $tracking; " +
           "wait $tracking; kill $master; wait) >" + path("said.txt") + " 2>&1");
  ASSERT_TRUE(fs::exists(path("live.json"))) << textOf("said.txt");
  const json live = json::parse(textOf("live.json"));
  EXPECT_EQ(live["live"][0]["dropped"], 0);
  EXPECT_EQ(live["live"][0]["repeated"], 0);
  EXPECT_EQ(live["live"][0]["clock"]["steps"], 0);
  EXPECT_EQ(live["live"][1]["unpaired"], 0);
  EXPECT_GT(live["camera_samples"], 50);
  // The stamps of images and motors are of one clock: an exposure keeps its place among the rows.
  const json direct = json::parse(textOf("direct.json"));
  for (int joint = 0; joint < 3; ++joint) {
    const double expected = direct["rms"]["cam"][joint];
    EXPECT_NEAR(live["rms"]["cam"][joint], expected, 0.05 * expected) << joint;
  }
  const auto motorRows = [&](const std::string& name) {
    const std::vector<double> camera = columnOf(name, "camera");
    std::vector<std::vector<double>> rows;
    for (const char* column : {"t", "q_kin1", "q_kin2", "q_kin3"}) {
      const std::vector<double> all = columnOf(name, column);
      auto& kept = rows.emplace_back();
      for (std::size_t k = 0; k < all.size(); ++k)
        if (camera[k] == 0.0) kept.push_back(all[k]);
    }
    return rows;
  };
  const auto played = motorRows("live.csv"), stored = motorRows("direct.csv");
  ASSERT_EQ(played[0].size(), stored[0].size()) << "rows are missing: " << textOf("said.txt");
  for (std::size_t joint = 1; joint <= 3; ++joint) EXPECT_EQ(played[joint], stored[joint]) << joint;
  for (std::size_t k = 0; k < stored[0].size(); ++k)
    ASSERT_NEAR(played[0][k] - played[0][0], stored[0][k] - stored[0][0], 1e-8) << k;
}

/// A wrong topic is answered with the nearest one; playing begins though nobody takes the images.
TEST_F(CliRos, MotorsAloneAreEnoughToPlayAndAWrongTopicIsNamed) {
  if (lacks("rosmaster")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --duration 4 --out " + path("trial.capstan")).exit, 0);
  const std::string motors = "title: x\nmotors:\n  from: ros:/arm/";
  std::ofstream(path("wrong.yaml")) << motors << "actuator/measured_js\n";
  std::ofstream(path("right.yaml")) << motors << "actuators/measured_js\n  encoders: /arm/measured_j\n";
  const std::string port = std::to_string(20000 + getpid() % 20000), program = test::commandLineProgram();
  runShell("export ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:" + port +
           "; (rosmaster --core -p " + port + " & master=$!; sleep 2; " + program + " play " +
           path("trial.capstan") + " --to ros 2>" + path("play.txt") +
           " & playing=$!; sleep 2; timeout -s INT 10 " + program + " track --live " + path("wrong.yaml") +
           " 2>" + path("wrong.txt") + "; timeout 30 " + program + " track --live " + path("right.yaml") +
           " --duration 2 --json " + path("live.json") + " 2>" + path("right.txt") +
           "; kill $playing; kill $master; wait) >/dev/null");
  EXPECT_NE(textOf("wrong.txt").find("the nearest topic with motors is /arm/actuators/measured_js"),
            std::string::npos)
      << textOf("wrong.txt");
  EXPECT_NE(
      textOf("right.txt").find("nobody publishes /arm/measured_j; the nearest topic with joint encoders"),
      std::string::npos)
      << textOf("right.txt");
  EXPECT_NE(textOf("play.txt").find("nobody has subscribed to both images"), std::string::npos)
      << textOf("play.txt");
  ASSERT_TRUE(fs::exists(path("live.json"))) << textOf("play.txt");
  EXPECT_GT(json::parse(textOf("live.json"))["live"][0]["received"], 500);
}

TEST_F(CliRos, WithoutAMasterPlayingIsRefused) {
  if (lacks("rosmaster")) GTEST_SKIP() << "ROS 1 is not installed";
  ASSERT_EQ(run("simulate --no-images --duration 1 --out " + path("a.capstan")).exit, 0);
  const Ran ran = run("play " + path("a.capstan") + " --to ros",
                      "ROS_HOSTNAME=localhost ROS_MASTER_URI=http://localhost:1 ");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("http://localhost:1"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find("Failed to contact"), std::string::npos) << "once is enough: " << ran.err;
}

}  // namespace
}  // namespace capstan::testing
