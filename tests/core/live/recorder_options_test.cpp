#include "core/live/recorder_options.h"

#include <gtest/gtest.h>

namespace capstan::live {
namespace {

TEST(RecorderOptions, HoldTwoSecondsOfASourceOfAnyRateAndSize) {
  tracking::SourceInfo info;
  info.rig.emplace();
  info.rig->left.width = info.rig->right.width = 1280;
  info.rig->left.height = info.rig->right.height = 720;
  RunStatus status;
  recording::RecorderOptions options = recorderOptionsFor(info, status);
  EXPECT_EQ(options.width, 1280);
  EXPECT_EQ(options.height, 720);
  EXPECT_NEAR(options.frame_rate, 15.0, 1e-12) << "what the pipeline expects";
  EXPECT_EQ(options.buffered_time, recording::RecorderOptions{}.buffered_time);
  status.frame_rate = 60.0;
  status.motor_rate = 2000.0;
  options = recorderOptionsFor(info, status);
  EXPECT_EQ(options.frame_rate, 60.0);
  EXPECT_EQ(options.motor_rate, 2000.0);
  EXPECT_EQ(options.buffered_time, 2.0);
  status = {};
  info.tracking = "camera_period: 0.0166666\n";
  EXPECT_NEAR(recorderOptionsFor(info, status).frame_rate, 60.0, 1e-9) << "before the first image";
  info.tracking.clear();
  info.real_time = true;
  options = recorderOptionsFor(info, status);
  EXPECT_NEAR(options.frame_rate * options.buffered_time, 120.0, 1e-9)
      << "before the rate of cameras is known";
  EXPECT_EQ(options.buffered_time, recording::RecorderOptions{}.buffered_time) << "rows need little room";
  info.rig.reset();
  EXPECT_EQ(recorderOptionsFor(info, status).width, 0) << "no memory for images that never come";
  EXPECT_FALSE(recorderOptionsFor(info, status).wait);
  info.sender_waits = true;
  EXPECT_TRUE(recorderOptionsFor(info, status).wait) << "nothing has to be dropped";
}

}  // namespace
}  // namespace capstan::live
