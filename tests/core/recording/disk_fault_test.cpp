// Disks that end: whatever stops a recording, the one file copied alone holds what came before.
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/base/error.h"
#include "core/recording/disk_space.h"
#include "core/recording/export.h"
#include "core/recording/recorder.h"
#include "core/recording/session_source.h"
#include "core/recording/sqlite.h"
#include "tests/core/recording/session_samples.h"
#include "tests/support/small_disk.h"

namespace capstan::recording {
namespace {

using namespace testing;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What a recording at the real rate left, seen in a copy of its one file.
struct Outcome {
  RecorderStats stats;
  double taken = -1.0;      ///< t of the newest sample that the recorder took [s]
  double stored = -1.0;     ///< of the newest motor sample in the copy [s]
  std::int64_t motor = 0;   ///< motor samples in the copy
  bool in_order = true;     ///< the copy has them from the first on without a gap
  double told_rate = 0.0;   ///< largest growth rate by which a time left was told [bytes/s]; 0: none was
  bool log_beside = false;  ///< something lay beside the file when the recorder had failed
};

void lookAtCopy(const std::filesystem::path& copy, Outcome& outcome) {
  SessionSource source(copy);
  for (tracking::Sample sample; source.next(sample);)
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      outcome.in_order = outcome.in_order && motor->position(0) == static_cast<double>(outcome.motor);
      outcome.stored = motor->t;
      ++outcome.motor;
    }
}

/// Records 1 kHz motors and 15 pairs of noise a second (7 MB/s) onto `path` until the recorder has failed,
/// copies that one file to `copy` and looks. `at_two_seconds`: what happens to the disk then.
Outcome recordUntilItFails(const std::filesystem::path& path, const std::filesystem::path& copy,
                           RecorderOptions options, const std::function<void()>& at_two_seconds = {}) {
  options.width = 320;
  options.height = 240;
  base::Random random(3);
  std::vector<cv::Mat> pictures;
  for (int i = 0; i < 4; ++i) pictures.push_back(noisyImage(random, 320, 240));
  Recorder recorder(path, header(), options);
  Outcome outcome;
  const double begin = now();
  bool happened = false;
  for (int tick = 0; tick < 20000; ++tick) {
    const double t = 1e-3 * tick;
    while (now() - begin < t) std::this_thread::sleep_for(std::chrono::microseconds(200));
    if (t >= 2.0 && !std::exchange(happened, true) && at_two_seconds) at_two_seconds();
    if (recorder.offer(
            tracking::Sample(tracking::MotorSample{t, {double(tick), 1, 2}, {3, 4, 5}, {6, 7, 8}})))
      outcome.taken = t;
    if (tick % 66 == 0)
      recorder.offer(tracking::Sample(tracking::StereoFrame{t, t, pictures[0], pictures[1]}));
    outcome.stats = recorder.stats();
    if (outcome.stats.state == RecorderState::kFailed) break;
    if (outcome.stats.time_left > 0.0)
      outcome.told_rate = std::max(
          outcome.told_rate, static_cast<double>(outcome.stats.free_bytes - outcome.stats.reserve_bytes) /
                                 outcome.stats.time_left);
  }
  EXPECT_EQ(outcome.stats.state, RecorderState::kFailed) << "the disk was never full";
  for (const char* suffix : {"-wal", "-shm", "-journal"})
    outcome.log_beside = outcome.log_beside || std::filesystem::exists(path.string() + suffix);
  std::filesystem::copy_file(path, copy);
  lookAtCopy(copy, outcome);
  return outcome;
}

void expectWhole(const Outcome& outcome) {
  EXPECT_GT(outcome.motor, 300) << outcome.stats.error;
  EXPECT_TRUE(outcome.in_order);
  EXPECT_LE(outcome.taken - outcome.stored, 0.5) << outcome.stats.error;
  EXPECT_FALSE(outcome.log_beside);
  EXPECT_NE(outcome.stats.error.find("intact"), std::string::npos) << outcome.stats.error;
  std::printf("taken to %.3f s, in the copy to %.3f s: lost %.3f s; %s\n", outcome.taken, outcome.stored,
              outcome.taken - outcome.stored, outcome.stats.error.c_str());
}

TEST(DiskFault, AFullDiskLeavesEverythingInTheOneFile) {
  const SmallDisk disk(16);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const TemporaryFolder away;
  RecorderOptions options;
  options.min_free_bytes = 0;  // to the last byte
  expectWhole(recordUntilItFails(disk / "a.capstan", away / "copy.capstan", options));
}

/// Another program takes the last byte, and every byte that becomes free afterwards.
TEST(DiskFault, ClosingNeedsNoFreeSpace) {
  const SmallDisk disk(48);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const TemporaryFolder away;
  RecorderOptions options;
  options.min_free_bytes = 0;
  std::atomic<bool> enough{false};
  std::thread greedy;
  const auto fill = [&] {
    greedy = std::thread([&] {
      std::ofstream other(disk / "other", std::ios::binary);
      const std::vector<char> block(1U << 16, 'x');
      while (!enough) {
        other.clear();
        other.write(block.data(), static_cast<std::streamsize>(block.size())).flush();
      }
    });
  };
  const Outcome outcome = recordUntilItFails(disk / "a.capstan", away / "copy.capstan", options, fill);
  enough = true;
  greedy.join();
  expectWhole(outcome);
}

TEST(DiskFault, TheReserveTakesEveryRowThatWasOffered) {
  const SmallDisk disk(128);  // a reserve of 12.8 MiB
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const TemporaryFolder away;
  const Outcome outcome = recordUntilItFails(disk / "a.capstan", away / "copy.capstan", {}, [&] {
    std::ofstream(disk / "other", std::ios::binary) << std::string(disk.freeBytes() - (16U << 20), 'x');
  });
  expectWhole(outcome);
  EXPECT_EQ(outcome.stats.lost, 0U);
  EXPECT_NE(outcome.stats.error.find("with every row"), std::string::npos) << outcome.stats.error;
  EXPECT_NE(outcome.stats.error.find("reserve of 13 MB"), std::string::npos) << outcome.stats.error;
  EXPECT_GT(disk.freeBytes(), 5U << 20);
}

/// The log was moved into the file and restarted many times before the disk was full.
TEST(DiskFault, AFullDiskAfterManyCheckpoints) {
  const SmallDisk disk(32);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const TemporaryFolder away;
  RecorderOptions options;
  options.min_free_bytes = 0;
  options.commit_interval = 0.02;
  options.checkpoint_bytes = 256U << 10;
  const Outcome outcome = recordUntilItFails(disk / "a.capstan", away / "copy.capstan", options);
  expectWhole(outcome);
  EXPECT_GT(outcome.stored, 2.5) << "the log takes the space of the file";
}

/// SQLite's own file system, whose logs take no byte while `broken`.
class BreakableDisk {
 public:
  BreakableDisk() {
    original() = sqlite3_vfs_find(nullptr);
    breakable_ = *original();
    breakable_.zName = "breakable";
    breakable_.xOpen = open;
    sqlite3_vfs_register(&breakable_, 1);
  }
  ~BreakableDisk() {
    broken() = false;
    sqlite3_vfs_register(original(), 1);
    sqlite3_vfs_unregister(&breakable_);
  }
  static std::atomic<bool>& broken() {
    static std::atomic<bool> value{false};
    return value;
  }

 private:
  using Write = int (*)(sqlite3_file*, const void*, int, sqlite3_int64);

  static sqlite3_vfs*& original() {
    static sqlite3_vfs* value = nullptr;
    return value;
  }
  static sqlite3_io_methods& methods() {
    static sqlite3_io_methods value{};
    return value;
  }
  static Write& realWrite() {
    static Write value = nullptr;
    return value;
  }
  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
    const int code = original()->xOpen(original(), name, file, flags, out);
    if (code != SQLITE_OK || !(flags & SQLITE_OPEN_WAL)) return code;
    if (file->pMethods->xWrite != writeUnlessBroken) realWrite() = file->pMethods->xWrite;
    methods() = *file->pMethods;
    methods().xWrite = writeUnlessBroken;
    file->pMethods = &methods();
    return code;
  }
  static int writeUnlessBroken(sqlite3_file* log, const void* data, int size, sqlite3_int64 at) {
    return broken() ? SQLITE_IOERR_WRITE : realWrite()(log, data, size, at);
  }

  sqlite3_vfs breakable_{};
};

TEST(DiskFault, AnErrorOfTheDiskLeavesEverythingInTheOneFile) {
  const BreakableDisk disk;
  const TemporaryFolder folder, away;
  expectWhole(recordUntilItFails(folder / "a.capstan", away / "copy.capstan", {},
                                 [] { BreakableDisk::broken() = true; }));
}

TEST(DiskFault, ALogThatCannotBeMovedIsNamed) {
  const BreakableDisk disk;
  const TemporaryFolder folder, away;
  std::optional<Database> reader;
  std::unique_ptr<Statement> held;
  const Outcome outcome = recordUntilItFails(folder / "a.capstan", away / "copy.capstan", {}, [&] {
    reader.emplace(folder / "a.capstan", Database::Mode::kRead);
    reader->run("BEGIN");
    held = std::make_unique<Statement>(*reader, "SELECT count(*) FROM motor");
    held->step();
    BreakableDisk::broken() = true;
  });
  EXPECT_TRUE(outcome.log_beside);
  EXPECT_NE(outcome.stats.error.find("a.capstan-wal. Keep the two files together"), std::string::npos)
      << outcome.stats.error;
  EXPECT_EQ(outcome.stats.error.find("intact"), std::string::npos) << outcome.stats.error;
}

TEST(DiskFault, ARemovedFileIsNotCalledWhole) {
  const TemporaryFolder folder;
  Recorder recorder(folder / "a.capstan", header());
  recorder.offer(tracking::Sample(tracking::MotorSample{0.0, {1, 2, 3}, {0, 0, 0}, {0, 0, 0}}));
  std::filesystem::remove(folder / "a.capstan");
  for (int i = 0; i < 500 && recorder.stats().state == RecorderState::kRecording; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const RecorderStats stats = recorder.stats();
  ASSERT_EQ(stats.state, RecorderState::kFailed);
  EXPECT_NE(stats.error.find("is lost"), std::string::npos) << stats.error;
  EXPECT_EQ(stats.error.find("intact"), std::string::npos) << stats.error;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "nothing stays behind";
}

TEST(DiskFault, RoomReserveAndTimeLeftAreKnown) {
  const SmallDisk disk(256);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const DiskSpace space = diskSpaceAt(disk / "not/yet/there");
  EXPECT_EQ(space.size, 256U << 20);
  EXPECT_EQ(space.reserve, (256U << 20) / 10);
  const TemporaryFolder away;
  const Outcome outcome = recordUntilItFails(disk / "a.capstan", away / "copy.capstan", {}, [&] {
    std::ofstream(disk / "other", std::ios::binary) << std::string(disk.freeBytes() - (50U << 20), 'x');
  });
  EXPECT_EQ(outcome.stats.reserve_bytes, space.reserve);
  EXPECT_GT(outcome.told_rate, 0.0) << "no time left was told";
  const auto recorded = static_cast<double>(std::filesystem::file_size(away / "copy.capstan"));
  EXPECT_LT(outcome.told_rate, recorded / 2.0) << "rates are means over at least two seconds";
  expectWhole(outcome);
}

/// The clock is given, so that the forecast does not depend on the speed of the machine.
TEST(DiskFault, TheTimeLeftIsTheRoomOverTheLastGrowthRate) {
  const auto at = [](double seconds) {
    return GrowthRate::Clock::time_point{} + std::chrono::milliseconds(std::llround(1e3 * seconds));
  };
  GrowthRate growth;
  growth.add(at(100.0), 5'000'000);
  EXPECT_EQ(growth.timeToGrow(50'000'000), 0.0) << "one size gives no rate";
  growth.add(at(101.9), 99'000'000);
  EXPECT_EQ(growth.timeToGrow(50'000'000), 0.0) << "less than two seconds give no rate";
  growth.add(at(102.5), 22'500'000);
  EXPECT_DOUBLE_EQ(growth.timeToGrow(50'000'000), 50.0 / 7.0);
  growth.add(at(105.0), 27'500'000);
  EXPECT_DOUBLE_EQ(growth.timeToGrow(50'000'000), 25.0);
  growth.add(at(107.5), 27'500'000);
  EXPECT_EQ(growth.timeToGrow(50'000'000), 0.0) << "a file that does not grow never fills the disk";
}

/// 1 kHz motors and 15 pairs of noise a second without end; `at_two_seconds` is called once.
class EndlessSource final : public tracking::Source {
 public:
  explicit EndlessSource(std::function<void()> at_two_seconds) : at_two_seconds_(std::move(at_two_seconds)) {
    info_.robot = raven();
    base::Random random(3);
    frame_.left = noisyImage(random, 320, 240);
    frame_.right = noisyImage(random, 320, 240);
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    t = 1e-3 * ticks_;
    if (t > 60.0) return false;
    if (t >= 2.0 && at_two_seconds_) std::exchange(at_two_seconds_, nullptr)();
    if (ticks_ % 66 == 65 && !std::exchange(imaged_, true)) {
      frame_.t = frame_.t_arrival = t;
      out = frame_;
      return true;
    }
    imaged_ = false;
    out = tracking::MotorSample{t, {double(ticks_++), 1, 2}, {3, 4, 5}, {6, 7, 8}};
    return true;
  }
  void block(bool, bool) override {}

  double t = 0.0;  ///< of the newest sample given

 private:
  tracking::SourceInfo info_;
  std::function<void()> at_two_seconds_;
  tracking::StereoFrame frame_;
  int ticks_ = 0;
  bool imaged_ = false;
};

std::string faultOfImport(tracking::Source& source, const std::filesystem::path& path, Existing existing,
                          OnFullDisk on_full_disk) {
  try {
    importRecording(source, path, headerOf(source.info(), "now"), nullptr, existing, on_full_disk);
  } catch (const base::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "the disk was never full";
  return {};
}

/// To the reserve, and to the last byte where another program takes it all at once.
TEST(DiskFault, WhatIsSimulatedOntoAFullDiskIsWhole) {
  for (const bool sudden : {false, true}) {
    const SmallDisk disk(32);
    if (!disk.mounted()) GTEST_SKIP() << disk.why();
    const TemporaryFolder away;
    // Left by a recording that was killed and whose main file somebody moved away.
    std::ofstream(disk / "a.capstan-wal") << "of a former recording";
    EndlessSource source([&] {
      std::ofstream other(disk / "other", std::ios::binary);
      if (sudden) other << std::string(disk.freeBytes(), 'x') << std::flush;
    });
    const std::string fault = faultOfImport(source, disk / "a.capstan", Existing::kRefuse, OnFullDisk::kKeep);
    const auto left = std::distance(std::filesystem::directory_iterator(disk.path()), {});
    EXPECT_EQ(left, 2) << "the session and the other file";
    std::filesystem::copy_file(disk / "a.capstan", away / "copy.capstan");
    Outcome outcome;
    lookAtCopy(away / "copy.capstan", outcome);
    EXPECT_GT(outcome.motor, 1500);
    EXPECT_TRUE(outcome.in_order);
    EXPECT_LE(source.t - outcome.stored, 0.5) << fault;
    EXPECT_NE(fault.find("is whole and holds the first"), std::string::npos) << fault;
    std::printf("given to %.3f s, in the copy to %.3f s: lost %.3f s; %s\n", source.t, outcome.stored,
                source.t - outcome.stored, fault.c_str());
  }
}

TEST(DiskFault, WhatIsConvertedOntoAFullDiskIsRemovedAndAFormerFileStays) {
  const SmallDisk disk(16);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  EndlessSource source({});
  std::string fault = faultOfImport(source, disk / "a.capstan", Existing::kRefuse, OnFullDisk::kDiscard);
  EXPECT_NE(fault.find("What was written is removed"), std::string::npos) << fault;
  EXPECT_TRUE(std::filesystem::is_empty(disk.path()));
  std::ofstream(disk / "a.capstan") << "former";
  fault = faultOfImport(source, disk / "a.capstan", Existing::kReplace, OnFullDisk::kKeep);
  EXPECT_NE(fault.find("The former file is as it was"), std::string::npos) << fault;
  EXPECT_EQ(std::filesystem::file_size(disk / "a.capstan"), 6U);
}

}  // namespace
}  // namespace capstan::recording
