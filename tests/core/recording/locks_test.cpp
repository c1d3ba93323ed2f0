// A recording and those who look at it meanwhile, in this process and in others.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "core/recording/recorder.h"
#include "core/recording/session_reader.h"
#include "core/recording/session_source.h"
#include "core/recording/table_source.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

void record(Recorder& recorder, int first, int count) {
  const std::uint64_t before = recorder.stats().written;
  for (int i = first; i < first + count; ++i)
    ASSERT_TRUE(recorder.offer(
        tracking::Sample(tracking::MotorSample{i * 1e-3, {double(i), 0, 0}, {0, 0, 0}, {0, 0, 0}})));
  while (recorder.stats().written < before + static_cast<std::uint64_t>(count)) {
    ASSERT_EQ(recorder.stats().state, RecorderState::kRecording) << recorder.stats().error;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::string integrityOf(const std::filesystem::path& path) {
  Database database = openSession(path);
  Statement check(database, "PRAGMA integrity_check");
  return check.step() ? check.text(0) : "no answer";
}

/// Another process that, when told, opens a database to write, reads from it and closes it again.
class Stranger {
 public:
  explicit Stranger(const std::filesystem::path& path) {
    EXPECT_EQ(pipe(pipe_.data()), 0);
    child_ = fork();
    if (child_ != 0) return;
    ::close(pipe_[1]);  // so that the parent's end is the last
    char go = 0;
    if (read(pipe_[0], &go, 1) != 1) _exit(1);
    bool read_all = false;
    try {
      Database database(path, Database::Mode::kReadWrite);
      read_all = database.number("SELECT count(*) FROM motor") > 0;
    } catch (const SqliteError&) {
    }
    _exit(read_all ? 0 : 1);
  }
  ~Stranger() {
    for (const int end : pipe_) ::close(end);
    if (child_ > 0) waitpid(child_, nullptr, 0);
  }
  bool openAndClose() {
    if (::write(pipe_[1], "g", 1) != 1) return false;
    int status = -1;
    waitpid(child_, &status, 0);
    child_ = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  std::array<int, 2> pipe_{};
  pid_t child_ = 0;
};

TEST(Locks, ClosingBesideAReaderIsNoFailure) {
  const TemporaryFolder folder;
  const auto path = folder / "a.capstan";
  Recorder recorder(path, header());
  record(recorder, 0, 500);
  {
    SessionSource reader(path);  // keeps its transaction
    tracking::Sample sample;
    ASSERT_TRUE(reader.next(sample));
    record(recorder, 500, 500);
    recorder.close();
    EXPECT_EQ(recorder.stats().state, RecorderState::kClosed) << recorder.stats().error;
    EXPECT_TRUE(recorder.stats().error.empty()) << recorder.stats().error;
    EXPECT_EQ(readSessionSummary(path).motor, 1000);
    int rest = 1;
    while (reader.next(sample)) ++rest;
    EXPECT_EQ(rest, 500) << "what was there when the reader began";
  }
  EXPECT_EQ(readSessionSummary(path).motor, 1000);
  EXPECT_EQ(integrityOf(path), "ok");
}

TEST(Locks, LookingAtARecordingDoesNotLoseItsLocks) {
  const TemporaryFolder folder;
  const auto path = folder / "a.capstan";
  Stranger stranger(path);
  Recorder recorder(path, header());
  record(recorder, 0, 500);
  EXPECT_EQ(readSessionSummary(path).motor, 500);
  EXPECT_EQ(openRecording(path, raven())->info().title, "a test");
  ASSERT_TRUE(stranger.openAndClose());
  EXPECT_TRUE(std::filesystem::exists(path.string() + "-wal"))
      << "the other process took itself for the last user and removed the log";
  record(recorder, 500, 500);
  recorder.close();
  EXPECT_EQ(recorder.stats().state, RecorderState::kClosed) << recorder.stats().error;
  EXPECT_EQ(readSessionSummary(path).motor, 1000);
  EXPECT_EQ(integrityOf(path), "ok");
}

}  // namespace
}  // namespace capstan::recording
