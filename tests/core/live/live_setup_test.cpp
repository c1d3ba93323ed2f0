/// Addresses in live set-up files.
#include "core/live/live_setup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "tests/core/live/setup_fault.h"

namespace capstan::live {
namespace {

std::string refusedTopic(const std::string& motors, const std::string& left = "ros:/left",
                         const std::string& right = "ros:/right") {
  return refusedKey("title: ROS\nmotors: {" + motors + "}\ncameras: {left: '" + left + "', right: '" + right +
                    "', calibration: ros}\n");
}

TEST(LiveSetup, TopicsHaveNamesOfRos) {
  EXPECT_EQ(refusedTopic("from: 'ros:/motors', encoders: /encoders"), "");
  EXPECT_EQ(refusedTopic("from: 'ros:motors'"), "motors.from");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors', encoders: encoders"), "motors.encoders");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors', encoders: 'ros:/encoders'"), "motors.encoders");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors'", "ros:stereo/left"), "cameras.left");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors'", "ros:/left", "ros:"), "cameras.right");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors'", "ros:/left-eye"), "cameras.left");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors'", "ros:/left image"), "cameras.left");
}

TEST(LiveSetup, OneStreamOrTopicIsNotTwo) {
  EXPECT_EQ(refusedTopic("from: 'ros:/motors', encoders: /motors"), "motors.encoders");
  EXPECT_EQ(refusedTopic("from: 'ros:/motors'", "ros:/left", "ros:/left"), "cameras.right");
  const std::string one =
      "title: x\nmotors: {from: '-'}\ncameras: {layout: side_by_side, calibration: rig, left: ";
  EXPECT_EQ(refusedKey(one + "/dev/video0}\n"), "");
  EXPECT_EQ(refusedKey(one + "''}\n"), "cameras.left");
}

TEST(LiveSetup, FieldsThatAnAddressDoesNotUseAreNamed) {
  RowsSetup rows;
  rows.read_as = "q_m=deg";
  EXPECT_TRUE(fieldsNotUsed(rows).empty());
  rows.encoders = "/arm/measured_js", rows.arm = 2;
  EXPECT_EQ(fieldsNotUsed(rows), (std::vector<std::string>{"encoders", "arm"}));
  rows.from = "ros:/arm/actuators/measured_js";
  EXPECT_EQ(fieldsNotUsed(rows), std::vector<std::string>{"read_as"});
}

TEST(LiveSetup, AnAddressWithoutItsKindAndAShortListHaveARemedy) {
  const auto refusedBy = [](const std::string& text) -> std::string {
    try {
      liveSetupOf(text, {}, {});
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusedBy("127.0.0.1:5555").find("Write tcp://127.0.0.1:5555"), std::string::npos)
      << refusedBy("127.0.0.1:5555");
  EXPECT_NE(refusedBy("http://127.0.0.1:8081").find("is no address of rows"), std::string::npos);
  EXPECT_NE(refusedBy("trial.capstan").find("is a recording"), std::string::npos);
  const std::string file = ::testing::TempDir() + "short.yaml";
  base::writeTextFile(file, "title: x\nmotors:\n  from: 127.0.0.1:5555\n");
  EXPECT_NE(refusedBy(file).find("short.yaml:3: motors.from = 127.0.0.1:5555"), std::string::npos)
      << refusedBy(file);
  EXPECT_NE(refusedBy(file).find("Write tcp://127.0.0.1:5555"), std::string::npos) << refusedBy(file);
  base::writeTextFile(file, "title: x\nmotors:\n  from: tcp://127.0.0.1:5555\n  signs: [1, 1]\n");
  const std::string said = refusedBy(file);
  EXPECT_NE(said.find("short.yaml:4: motors.signs = 2 values"), std::string::npos) << said;
  EXPECT_NE(said.find("Give 3 values, as in signs: […, …, …]"), std::string::npos) << said;
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace capstan::live
