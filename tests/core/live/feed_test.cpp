// One writer and its readers in shared memory: what is read, and processes that are killed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <opencv2/core.hpp>
#include <thread>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_reader.h"
#include "core/live/feed/feed_writer.h"
#include "tests/core/live/feed_child.h"

namespace capstan::live {
namespace {

using testing::Child;
using testing::feedNamed;
using Link = FeedReader::Link;

/// Images of one value, that of the state: a torn copy mixes two.
void publishValue(FeedWriter& writer, int value) {
  FeedState state;
  state.t = value;
  const cv::Scalar colour = cv::Scalar::all(value % 251);
  writer.publish(state, cv::Mat(240, 320, CV_8UC3, colour), cv::Mat(240, 320, CV_8UC1, colour));
}

bool allOf(const cv::Mat& image, double value) {
  double least = 0.0, most = 0.0;
  cv::minMaxLoc(image.reshape(1), &least, &most);
  return least == value && most == value;
}

/// Publishes on and on, in a process of its own.
void publishForEver(const std::string& name, const std::function<void()>& ready) {
  FeedWriter writer(name);
  publishValue(writer, 1);
  ready();
  for (int value = 2;; ++value) publishValue(writer, value);
}

/// Reads until `condition`; false after ten seconds.
bool readUntil(FeedReader& reader, FeedFrame& frame, const std::function<bool()>& condition) {
  const std::int64_t end = feedNow() + 10'000'000'000;
  while (!condition()) {
    if (feedNow() > end) return false;
    reader.read(frame, feedNow());
    usleep(5'000);
  }
  return true;
}

TEST(Feed, CarriesStateAndImages) {
  FeedWriter writer(feedNamed("carries"));
  FeedReader reader(writer.name());
  FeedFrame frame;
  EXPECT_FALSE(reader.read(frame, feedNow())) << "nothing is published yet";
  EXPECT_EQ(reader.link(), Link::kLive);

  cv::Mat wide(10, 40, CV_8UC3);
  for (int i = 0; i < 1200; ++i) wide.data[i] = static_cast<std::uint8_t>(i % 256);
  const cv::Mat left = wide(cv::Rect(3, 2, 7, 5));  // rows that are not beside each other
  const cv::Mat right(3, 5, CV_8UC1, cv::Scalar(77));
  FeedState state;
  state.t = 1.25;
  state.tracking = FeedTracking::kOccluded;
  state.eyes[1].ellipse = {5.0, 2.0, 0.5};
  setText(state.words, "both lost");
  writer.publish(state, left, right);

  ASSERT_TRUE(reader.read(frame, feedNow()));
  EXPECT_EQ(frame.state.number, 1U);
  EXPECT_EQ(frame.state.t, 1.25);
  EXPECT_EQ(frame.state.tracking, FeedTracking::kOccluded);
  EXPECT_EQ(frame.state.eyes[1].ellipse, state.eyes[1].ellipse);
  EXPECT_EQ(textOf(frame.state.words), "both lost");
  EXPECT_LE(frame.state.published_ns, feedNow());
  ASSERT_EQ(frame.images[0].size(), left.size());
  EXPECT_EQ(cv::norm(frame.images[0], left, cv::NORM_INF), 0.0);
  ASSERT_EQ(frame.images[1].size(), right.size());
  EXPECT_EQ(cv::norm(frame.images[1], right, cv::NORM_INF), 0.0);
  EXPECT_FALSE(reader.read(frame, feedNow())) << "each state is read once";

  writer.publish(state);
  ASSERT_TRUE(reader.read(frame, feedNow()));
  EXPECT_EQ(frame.state.eyes[0].image, FeedImage::kUnchanged);
  writer.setRun(FeedRun::kPaused);
  EXPECT_EQ(reader.run(), FeedRun::kPaused);
}

TEST(Feed, NamesTheReasonWhereAnEyeHasNoImage) {
  FeedWriter writer(feedNamed("reasons"));
  FeedReader reader(writer.name());
  FeedFrame frame;
  const auto sent = [&](const cv::Mat& image) {
    FeedState state;
    writer.publish(state, image, {});
    EXPECT_TRUE(reader.read(frame, feedNow()));
    EXPECT_TRUE(frame.images[0].empty());
    EXPECT_EQ(frame.state.eyes[1].image, FeedImage::kNone);
    return frame.state.eyes[0].image;
  };
  EXPECT_EQ(sent(cv::Mat(4, kFeedWidth + 1, CV_8UC1)), FeedImage::kTooLarge);
  EXPECT_EQ(sent(cv::Mat(4, 4, CV_16UC1)), FeedImage::kFormat);
  EXPECT_EQ(sent(cv::Mat(4, 4, CV_8UC4)), FeedImage::kFormat);
}

/// Every third state is large and lies in the same slot. The writer begins to overwrite it after a random
/// time, mostly while the reader copies it.
void publishOverTheReader(FeedWriter& writer, const std::atomic<bool>& done) {
  base::Random random(6);
  for (int value = 1; !done; ++value) {
    const bool large = value % 3 == 0;
    const cv::Size size = large ? cv::Size(640, 480) : cv::Size(1, 1);
    const cv::Scalar colour = cv::Scalar::all(value % 251);
    FeedState state;
    state.t = value;
    writer.publish(state, cv::Mat(size, CV_8UC3, colour), cv::Mat(size, CV_8UC1, colour));
    const std::int64_t next = feedNow() + (large ? static_cast<std::int64_t>(random.uniform(0.0, 3e5)) : 0);
    while (feedNow() < next && !done) continue;
  }
}

TEST(Feed, NeverGivesHalfOfOneStateAndHalfOfAnother) {
  FeedWriter writer(feedNamed("torn"));
  std::atomic<bool> done{false};
  std::thread publishing([&] { publishOverTheReader(writer, done); });
  FeedReader reader(writer.name());
  FeedFrame frame;
  int frames = 0, torn = 0;
  double before = 0.0;
  const std::int64_t end = feedNow() + 3'000'000'000;  // on two busy cores few copies are spoilt
  while ((frames < 500 || reader.overtaken() < 50) && feedNow() < end) {
    if (!reader.read(frame, feedNow())) continue;
    ++frames;
    const double value = static_cast<int>(frame.state.t) % 251;
    torn += frame.state.t <= before || !allOf(frame.images[0], value) || !allOf(frame.images[1], value);
    before = frame.state.t;
  }
  done = true;
  publishing.join();
  EXPECT_GT(frames, 0);
  EXPECT_EQ(torn, 0);
}

TEST(Feed, AReaderSurvivesAKilledWriterAndTakesTheNextOne) {
  const std::string name = feedNamed("killed");
  FeedReader reader(name);
  FeedFrame frame;
  EXPECT_FALSE(reader.read(frame, feedNow()));
  EXPECT_EQ(reader.link(), Link::kWaiting) << "it may begin before the session";
  Child session([&](const auto& ready) { publishForEver(name, ready); });
  ASSERT_TRUE(readUntil(reader, frame, [&] { return frame.state.t > 0.0; }));
  session.kill();
  reader.read(frame, feedNow());
  EXPECT_EQ(reader.link(), Link::kLive) << "a short silence is no death";
  ASSERT_TRUE(readUntil(reader, frame, [&] { return reader.link() == Link::kEnded; }));
  EXPECT_EQ(reader.run(), FeedRun::kEnded);

  FeedWriter next(name);  // takes over what the killed one has left
  publishValue(next, -5);
  EXPECT_TRUE(readUntil(reader, frame, [&] { return frame.state.t == -5.0; }));
  EXPECT_EQ(reader.feeds(), 2U);
  EXPECT_EQ(reader.link(), Link::kLive);
}

TEST(Feed, AWriterThatEndsIsKnownAtOnceAndLeavesNothing) {
  const std::string name = feedNamed("ends");
  FeedReader reader(name);
  FeedFrame frame;
  {
    FeedWriter writer(name);
    publishValue(writer, 1);
    ASSERT_TRUE(reader.read(frame, feedNow()));
  }
  EXPECT_FALSE(reader.read(frame, feedNow()));
  EXPECT_EQ(reader.link(), Link::kEnded);
  struct stat status {};
  EXPECT_NE(stat(("/dev/shm" + segmentName(name)).c_str(), &status), 0);
}

/// A process that is stopped for long (a debugger, a laptop's lid) is dead for its readers until it goes on.
TEST(Feed, AWriterThatWasStoppedIsTakenBack) {
  const std::string name = feedNamed("stopped");
  Child session([&](const auto& ready) { publishForEver(name, ready); });
  FeedReader reader(name);
  FeedFrame frame;
  ASSERT_TRUE(reader.read(frame, feedNow()));
  session.send(SIGSTOP);
  EXPECT_TRUE(readUntil(reader, frame, [&] { return reader.link() == Link::kEnded; }));
  session.send(SIGCONT);
  EXPECT_TRUE(readUntil(reader, frame, [&] { return reader.link() == Link::kLive; }));
  EXPECT_EQ(reader.feeds(), 1U);
  session.kill();
  const FeedWriter last(name);  // removes what the killed one has left
}

TEST(Feed, AWriterSurvivesKilledAndStoppedReaders) {
  const std::string name = feedNamed("readers");
  FeedWriter writer(name);
  publishValue(writer, 1);
  const auto readForEver = [&](const auto& ready) {
    FeedReader reader(name);
    FeedFrame frame;
    reader.read(frame, feedNow());
    ready();
    while (true) reader.read(frame, feedNow());
  };
  Child killed(readForEver), stopped(readForEver);
  stopped.send(SIGSTOP);
  for (int value = 2; value < 40; ++value) {
    publishValue(writer, value);
    if (value == 20) killed.kill();
  }
  FeedReader reader(name);
  FeedFrame frame;
  ASSERT_TRUE(reader.read(frame, feedNow()));
  EXPECT_EQ(frame.state.t, 39.0);
}

TEST(Feed, HasOneWriter) {
  const std::string name = feedNamed("single");
  const FeedWriter writer(name);
  try {
    const FeedWriter second(name);
    FAIL() << "two writers share a feed";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("another running session uses this name"), std::string::npos)
        << error.what();
  }
}

TEST(Feed, IsOfItsUserAlone) {
  const std::string name = feedNamed("private");
  const mode_t before = umask(0);
  const FeedWriter writer(name);
  umask(before);
  struct stat status {};
  ASSERT_EQ(stat(("/dev/shm" + segmentName(name)).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  EXPECT_EQ(status.st_uid, geteuid());
}

TEST(Feed, RefusesNamesThatAreNone) {
  for (const char* name : {"", "a/b", "..", "a b", "ä", "12345678901234567890123456789012345678901"})
    EXPECT_THROW(segmentName(name), base::InputError) << name;
  EXPECT_EQ(segmentName("or-2_b"), "/capstan-" + std::to_string(geteuid()) + "-or-2_b");
}

}  // namespace
}  // namespace capstan::live
