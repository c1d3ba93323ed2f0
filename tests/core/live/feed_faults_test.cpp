// Shared memory that another program has written, or that is damaged.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <memory>

#include "core/base/random.h"
#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_layout.h"
#include "core/live/feed/feed_reader.h"
#include "core/live/feed/feed_writer.h"
#include "tests/core/live/feed_child.h"

namespace capstan::live {
namespace {

using testing::feedNamed;
using Link = FeedReader::Link;

/// Shared memory under a feed's name, with a header of the test's making.
class Foreign {
 public:
  Foreign(const std::string& name, std::size_t bytes) : segment_(segmentName(name)) {
    descriptor_ = shm_open(segment_.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
    EXPECT_EQ(ftruncate(descriptor_, static_cast<off_t>(bytes)), 0);
  }
  ~Foreign() {
    close(descriptor_);
    shm_unlink(segment_.c_str());
  }
  Foreign(const Foreign&) = delete;
  Foreign& operator=(const Foreign&) = delete;
  void write(const FeedHeader& header) const {
    EXPECT_EQ(pwrite(descriptor_, &header, sizeof header, 0), static_cast<ssize_t>(sizeof header));
  }

 private:
  std::string segment_;
  int descriptor_;
};

FeedHeader goodHeader() {
  FeedHeader header{};
  header.magic = kFeedMagic;
  header.version = kFeedVersion;
  header.slot_count = kFeedSlots;
  header.state_bytes = sizeof(FeedState);
  header.total_bytes = kFeedBytes;
  header.heartbeat_ns = feedNow();
  return header;
}

/// Words of the fault that a reader finds; empty: it takes the segment.
std::string faultOf(const FeedHeader& header, std::size_t bytes = kFeedBytes) {
  const std::string name = feedNamed("foreign");
  const Foreign segment(name, bytes);
  segment.write(header);
  FeedReader reader(name);
  FeedFrame frame;
  EXPECT_FALSE(reader.read(frame, feedNow()));
  EXPECT_EQ(reader.link() == Link::kRefused, !reader.fault().empty());
  return reader.fault();
}

TEST(FeedFaults, AnotherVersionIsRefusedWithBothNumbers) {
  EXPECT_EQ(faultOf(goodHeader()), "");
  FeedHeader header = goodHeader();
  header.version = kFeedVersion + 41;
  const std::string fault = faultOf(header);
  EXPECT_NE(fault.find("feed version " + std::to_string(kFeedVersion + 41)), std::string::npos) << fault;
  EXPECT_NE(fault.find("reads " + std::to_string(kFeedVersion)), std::string::npos) << fault;
}

TEST(FeedFaults, AnotherLayoutIsRefused) {
  FeedHeader header = goodHeader();
  header.magic ^= 1;
  EXPECT_NE(faultOf(header), "");
  header = goodHeader();
  header.slot_count = 1000;
  EXPECT_NE(faultOf(header), "");
  header = goodHeader();
  header.state_bytes += 8;
  EXPECT_NE(faultOf(header), "");
  header = goodHeader();
  header.total_bytes *= 2;
  EXPECT_NE(faultOf(header), "");
  EXPECT_NE(faultOf(goodHeader(), 4096), "") << "a header alone";
}

TEST(FeedFaults, AHeaderThatIsNotFinishedIsWaitedFor) {
  FeedHeader header = goodHeader();
  header.magic = 0;  // it is written last
  EXPECT_EQ(faultOf(header), "");
}

TEST(FeedFaults, AReaderGoesOnWhenTheForeignSegmentIsReplaced) {
  const std::string name = feedNamed("replaced");
  FeedReader reader(name);
  FeedFrame frame;
  {
    const Foreign segment(name, 4096);
    reader.read(frame, feedNow());
    EXPECT_EQ(reader.link(), Link::kRefused);
  }
  FeedWriter writer(name);
  FeedState state;
  writer.publish(state);
  EXPECT_TRUE(reader.read(frame, feedNow() + 100'000'000));
}

/// As at any instant between the writer's first and last word of a state.
TEST(FeedFaults, ASlotThatIsBeingFilledIsNotRead) {
  FeedWriter writer(feedNamed("filled"));
  const int descriptor = shm_open(segmentName(writer.name()).c_str(), O_RDWR, 0);
  ASSERT_GE(descriptor, 0);
  const FeedSegment memory(descriptor, true);
  FeedState state;
  writer.publish(state, cv::Mat(6, 8, CV_8UC1, cv::Scalar(9)), {});
  FeedReader reader(writer.name());
  FeedFrame frame;
  auto& sequence = memory.as<FeedSlot>(slotOffset(1)).sequence;
  for (const std::uint64_t other : {1U, 7U, 8U, 0U}) {  // filling 1; filling and holding 4; empty
    sequence = other;
    EXPECT_FALSE(reader.read(frame, feedNow())) << other;
  }
  EXPECT_GT(reader.overtaken(), 0U);
  sequence = 2;
  EXPECT_TRUE(reader.read(frame, feedNow()));
}

/// Every value that a reader hands on must be usable as it is, whatever bytes it has found.
void expectUsable(const FeedFrame& frame) {
  for (std::size_t side = 0; side < 2; ++side) {
    const FeedEye& eye = frame.state.eyes[side];
    const cv::Mat& image = frame.images[side];
    ASSERT_TRUE(image.empty() || (image.cols <= kFeedWidth && image.rows <= kFeedHeight));
    ASSERT_LE(eye.shaft_points, kFeedShaft);
    for (int i = 0; i < eye.shaft_points; ++i)
      ASSERT_TRUE(std::isfinite(eye.shaft[static_cast<std::size_t>(i)][0]));
    if (eye.tip_found) {
      ASSERT_TRUE(std::isfinite(eye.tip[0]) && std::isfinite(eye.tip[1]) && eye.tip[2] >= 0.0);
      ASSERT_TRUE(std::isfinite(eye.ellipse[0]) && std::isfinite(eye.ellipse[2]));
    }
  }
  ASSERT_LT(textOf(frame.state.words).size(), frame.state.words.size());
}

TEST(FeedFaults, DamagedStatesAreRefusedOrMadeSafe) {
  const std::string name = feedNamed("damaged");
  FeedWriter writer(name);
  const int descriptor = shm_open(segmentName(name).c_str(), O_RDWR, 0);
  ASSERT_GE(descriptor, 0);
  const FeedSegment memory(descriptor, true);
  base::Random random(4);
  const auto below = [&](double limit) { return static_cast<std::size_t>(random.uniform(0.0, limit)); };
  auto reader = std::make_unique<FeedReader>(name);
  FeedFrame frame;
  int read = 0, refused = 0;
  for (std::uint64_t number = 1; number <= 10'000; ++number) {
    FeedState state;
    for (FeedEye& eye : state.eyes) eye.tip_found = eye.marker_found = eye.shaft_points = 1;
    writer.publish(state, cv::Mat(6, 8, CV_8UC1), {});
    std::byte* bytes = memory.at(slotOffset(number) + offsetof(FeedSlot, state));
    for (std::size_t flips = 1 + below(6.0); flips > 0; --flips)  // the number itself stays
      bytes[8 + below(sizeof(FeedState) - 8.001)] = static_cast<std::byte>(below(255.999));
    if (reader->read(frame, feedNow())) {
      ++read;
      expectUsable(frame);
    }
    if (reader->link() == Link::kRefused) {
      ++refused;
      reader = std::make_unique<FeedReader>(name);
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace capstan::live
