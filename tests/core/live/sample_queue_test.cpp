#include "core/live/sample_queue.h"

#include <gtest/gtest.h>

namespace capstan::live {
namespace {

/// A pause of a sender that waits: its rows are kept, images are not, and there is room for new ones.
TEST(SampleQueue, ImagesAreDiscardedAndRowsKept) {
  SampleQueue queue(10, 2);
  for (int k = 0; k < 2; ++k) {
    EXPECT_TRUE(queue.offer(tracking::MotorSample{0.1 * k, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
    EXPECT_TRUE(queue.offer(tracking::StereoFrame{0.1 * k, 0.1 * k, {}, {}}));
  }
  EXPECT_FALSE(queue.offer(tracking::StereoFrame{})) << "full";
  queue.clearFrames();
  tracking::Sample sample;
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(queue.ready({}));
    queue.take(sample);
    ASSERT_TRUE(std::holds_alternative<tracking::MotorSample>(sample));
    EXPECT_EQ(std::get<tracking::MotorSample>(sample).t, 0.1 * k);
  }
  EXPECT_FALSE(queue.ready({}));
  EXPECT_TRUE(queue.offer(tracking::StereoFrame{}));
}

}  // namespace
}  // namespace capstan::live
