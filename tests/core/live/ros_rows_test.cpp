/// What a live source of ROS topics says of its joints.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/live/live_source.h"

namespace capstan::live {
namespace {

tracking::SourceInfo infoOf(const std::string& encoders, bool reference) {
  setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
  setenv("ROS_HOSTNAME", "127.0.0.1", 1);
  LiveSetup setup;
  setup.motors.from = "ros:/ravenstate";
  setup.motors.encoders = encoders;
  setup.motors.reference = reference;
  return LiveSource(setup).info();
}

/// The RAVEN-II's state has joints, which its software computes from the motors.
TEST(RosRows, JointsInMessagesOfMotorsAreTheRobotsOwnKinematics) {
  EXPECT_TRUE(infoOf("", true).own_kinematics);
  EXPECT_FALSE(infoOf("", false).own_kinematics) << "they are not used";
  const tracking::SourceInfo measured = infoOf("/arm/encoders/measured_js", true);
  EXPECT_TRUE(measured.reference);
  EXPECT_FALSE(measured.own_kinematics);
}

}  // namespace
}  // namespace capstan::live
