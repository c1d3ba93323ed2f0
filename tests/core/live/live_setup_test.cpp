/// Addresses in live set-up files.
#include "core/live/live_setup.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace capstan::live
