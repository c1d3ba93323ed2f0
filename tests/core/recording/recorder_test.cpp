// The data path never waits, never allocates, counts what it drops; failures are states.
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/base/error.h"
#include "core/recording/recorder.h"
#include "core/recording/session_source.h"
#include "tests/core/recording/session_samples.h"
#include "tests/support/process_use.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CAPSTAN_COUNTS_ALLOCATIONS 0
#else
#define CAPSTAN_COUNTS_ALLOCATIONS 1
#endif

namespace {
thread_local long allocations = 0;  // of this thread: the writer's are its own affair
}

#if CAPSTAN_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT: glibc's own name
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT: glibc's own name
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++allocations;
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : 12;
}
}
#endif

namespace capstan::recording {
namespace {

using namespace testing;

/// Holds the writer before its commit until released.
class Gate {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return open_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void awaitArrival() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return arrived_ > 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
  bool open_ = false;
};

tracking::Sample motor(int i) {
  return tracking::MotorSample{i * 1e-3, {double(i), 0, 0}, {0, 0, 0}, {0, 0, 0}};
}

template <class Condition>
bool eventually(Condition&& condition) {
  for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

TEST(Recorder, AStalledDiskDropsAndCountsButNeverHoldsTheDataPath) {
  const TemporaryFolder folder;
  Gate gate;
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  options.before_commit = [&] { gate.wait(); };
  Recorder recorder(folder / "a.capstan", header(), options);
  recorder.offer(motor(0));
  gate.awaitArrival();

  // The writer stands still: a data path that waited for it would never come out of this loop.
  const int offered = 30000;
  int taken = 1;
  for (int i = 1; i < offered; ++i) taken += recorder.offer(motor(i));
  RecorderStats stats = recorder.stats();
  EXPECT_LT(taken, offered);
  EXPECT_GE(taken, 2 * 3 * 1000) << "less than two seconds of everything";
  EXPECT_EQ(stats.queued, static_cast<std::uint64_t>(taken));
  EXPECT_EQ(stats.dropped, static_cast<std::uint64_t>(offered - taken));
  EXPECT_EQ(stats.written, 0U);

  gate.open();
  recorder.close();
  stats = recorder.stats();
  EXPECT_EQ(stats.written, static_cast<std::uint64_t>(taken));
  EXPECT_EQ(readSessionSummary(folder / "a.capstan").motor, taken);
}

TEST(Recorder, TheQueueHoldsTwoSecondsOfFramesToo) {
  const TemporaryFolder folder;
  Gate gate;
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  options.before_commit = [&] { gate.wait(); };
  Recorder recorder(folder / "a.capstan", header(), options);
  recorder.offer(motor(0));
  gate.awaitArrival();
  base::Random random(1);
  const tracking::Sample frame = tracking::StereoFrame{0.0, 0.0, noisyImage(random), noisyImage(random)};
  int taken = 0;
  for (int i = 0; i < 1000; ++i) taken += recorder.offer(frame);
  EXPECT_GE(taken, 30);
  EXPECT_LT(taken, 1000);
  EXPECT_EQ(recorder.stats().dropped_frames, static_cast<std::uint64_t>(1000 - taken));
  gate.open();
  recorder.close();
  EXPECT_EQ(recorder.stats().frames, static_cast<std::uint64_t>(taken));
}

TEST(Recorder, TheMemoryOfItsImagesEndsWithTheRecording) {
  const TemporaryFolder folder;
  const double before = test::residentMegabytes();
  RecorderOptions options;
  options.frame_rate = 60.0, options.buffered_time = 2.0;  // 123 pairs of 640 × 480: 227 MB
  Recorder recorder(folder / "a.capstan", header(), options);
  for (int k = 0; k < 500 && test::residentMegabytes() - before < 150.0; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (test::residentMegabytes() - before < 150.0) GTEST_SKIP() << "this system populates no memory ahead";
  recorder.close();
  EXPECT_LT(test::residentMegabytes() - before, 50.0);
  EXPECT_FALSE(recorder.offer(tracking::StereoFrame{1.0, 1.0, cv::Mat(480, 640, CV_8UC3), {}}));
}

TEST(Recorder, ImagesThatDoNotFitIntoMemoryAreRefusedBeforeThereIsAFile) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.width = options.height = 60'000;  // 1.5 TB, which mmap() may promise
  try {
    Recorder(folder / "a.capstan", header(), options);
    ADD_FAILURE() << "recorded";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of memory for the images are not available"), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.capstan"));
}

TEST(Recorder, OfferDoesNotAllocate) {
  if (!CAPSTAN_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns malloc";
  const long at_start = allocations;
  const cv::Mat proof(48, 64, CV_8UC3);
  ASSERT_GT(allocations, at_start) << "the counter does not count images";

  const TemporaryFolder folder;
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  Recorder recorder(folder / "a.capstan", header(), options);
  const auto samples = someSamples(1, 100);
  base::Random random(1);
  const tracking::Snapshot snapshot = someSnapshot(random);
  const long before = allocations;
  for (const auto& sample : samples) recorder.offer(sample);
  for (int i = 0; i < 1000; ++i) recorder.offer(snapshot);
  EXPECT_EQ(allocations, before);
}

TEST(Recorder, AFullDiskIsAStateAndLeavesAWholeFile) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  options.max_bytes = 1U << 20;
  Recorder recorder(folder / "a.capstan", header(), options);
  base::Random random(1);
  std::uint64_t offered = 0;
  ASSERT_TRUE(eventually([&] {
    for (int i = 0; i < 20; ++i, ++offered)
      recorder.offer(
          tracking::Sample(tracking::StereoFrame{0.0, 0.0, noisyImage(random), noisyImage(random)}));
    return recorder.stats().state == RecorderState::kFailed;
  }));
  EXPECT_FALSE(recorder.offer(motor(1))) << "taken after the failure";
  recorder.close();
  const RecorderStats stats = recorder.stats();
  EXPECT_EQ(stats.state, RecorderState::kFailed);
  EXPECT_NE(stats.error.find("a.capstan"), std::string::npos) << stats.error;
  EXPECT_NE(stats.error.find("Free space"), std::string::npos) << stats.error;
  EXPECT_LT(stats.written, offered);
  EXPECT_EQ(stats.written + stats.lost + stats.dropped, offered + 1) << "each is one of these";

  SessionSource source(folder / "a.capstan");
  std::uint64_t back = 0;
  for (tracking::Sample sample; source.next(sample);) ++back;
  EXPECT_EQ(back, stats.written);
}

TEST(Recorder, AFolderThatGoesAwayIsAState) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  Recorder recorder(folder / "in/a.capstan", header());
  std::filesystem::remove_all(folder / "in");
  EXPECT_TRUE(eventually([&] { return recorder.stats().state == RecorderState::kFailed; }));
  EXPECT_NE(recorder.stats().error.find("gone"), std::string::npos) << recorder.stats().error;
}

TEST(Recorder, RefusesADiskThatHasOnlyItsReserveLeft) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.min_free_bytes = std::uint64_t{1} << 60;
  try {
    const Recorder recorder(folder / "a.capstan", header(), options);
    FAIL() << "recorded";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("in reserve"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Recorder, ADiskThatDoesNotSayWhatIsFreeIsRecordedTo) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.min_free_bytes = 1U << 20;
  options.disk_space = [](const std::filesystem::path&) { return DiskSpace{}; };
  Recorder recorder(folder / "a.capstan", header(), options);
  EXPECT_FALSE(recorder.stats().free_known);
  // Longer than the recorder takes to look at the disk again.
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(800); ++i) {
    recorder.offer(motor(i));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(recorder.stats().state, RecorderState::kRecording) << recorder.stats().error;
  recorder.close();
  EXPECT_EQ(recorder.stats().written, recorder.stats().queued);
}

TEST(Recorder, ALogBeyondItsThresholdMovesIntoTheFile) {
  const TemporaryFolder folder;
  RecorderOptions options;
  options.commit_interval = 0.01;
  options.checkpoint_bytes = 256U << 10;
  options.motor_rate = 20000.0;
  Recorder recorder(folder / "a.capstan", header(), options);
  int offered = 0;
  const auto path = folder / "a.capstan";
  EXPECT_TRUE(eventually([&] {
    for (int i = 0; i < 500; ++i) offered += recorder.offer(motor(offered));
    return std::filesystem::file_size(path) > (1U << 20);
  }));
  recorder.close();
  EXPECT_EQ(readSessionSummary(path).motor, offered);
}

}  // namespace
}  // namespace capstan::recording
