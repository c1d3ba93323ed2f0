#include "core/live/recording_slot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/recording/session_file.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::live {
namespace {

using ::testing::HasSubstr;

std::vector<recording::SessionEvent> recordedWith(int samples) {
  const test::TemporaryFolder folder;
  std::promise<void> disk;
  recording::RecorderOptions options;
  options.before_commit = [free = disk.get_future().share()] { free.wait(); };
  {
    RecordingSlot slot(1000.0);
    slot.begin(
        std::make_shared<recording::Recorder>(folder / "a.capstan", recording::testing::header(), options));
    for (int k = 0; k < samples; ++k) {
      slot.offer(tracking::Sample(tracking::MotorSample{1e-3 * k, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
      tracking::Snapshot snapshot{};
      snapshot.t = 1e-3 * k;
      slot.offer(snapshot);
    }
    slot.end();
    disk.set_value();
  }
  return recording::readSessionEvents(folder / "a.capstan");
}

TEST(RecordingSlot, ARecordingSaysThatItHasGaps) {
  EXPECT_TRUE(recordedWith(100).empty());
  const auto events = recordedWith(30000);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, "recorder");
  EXPECT_NEAR(events[0].t, 29.999, 1e-9);
  EXPECT_THAT(
      events[0].text,
      HasSubstr("samples are missing. The disk, or the encoding of the images, was slower than the data."));
}

}  // namespace
}  // namespace capstan::live
