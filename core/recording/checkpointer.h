#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Moves a growing write-ahead log into its database on its own thread, so that commits of the writer never
/// wait for a sync of the disk (0.6 s or more while video is written).
///
/// The writer runs with synchronous = OFF: a commit is a write() to the operating system, which survives the
/// process. This thread does the syncs. Each passive checkpoint syncs the log, copies its pages and syncs the
/// database. When the writer has restarted the log, this thread syncs its first page, so that the old or the
/// new log is complete after a loss of power. If a log was copied completely between two commits, the next
/// commit restarts it; this limits the log to about `threshold` bytes as long as the disk keeps up.
/// Checkpoints never shorten the main file, because the writer has reserved room there for pages that are
/// still in the log.
class Checkpointer {
 public:
  Checkpointer(const std::filesystem::path& path, std::uint64_t threshold);
  ~Checkpointer();
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;

  /// Makes the commits of `writer` report the length of the log.
  void watch(Database& writer);
  /// Starts a checkpoint after a commit if there is work. Does not wait.
  void wake();
  /// Ends the thread after a checkpoint under way. Idempotent.
  void stop();

  std::uint64_t logBytes() const { return pages_.load(std::memory_order_relaxed) * page_bytes_; }

 private:
  static int onCommit(void* self, sqlite3* database, const char* name, int pages);
  void work();
  /// Keeps checkpoints of `database` from shortening the main file to the pages copied so far.
  void keepLengthOf(Database& database);
  void checkpoint(Database& database);
  void syncLog();

  const std::filesystem::path path_;
  const std::uint64_t threshold_;
  sqlite3_io_methods methods_{};  ///< methods of this thread's main file: those of the VFS without truncation
  std::uint64_t page_bytes_ = 0;
  std::atomic<std::uint64_t> pages_{0};
  std::atomic<bool> restarted_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool due_ = false, stopping_ = false;
  std::thread thread_;
};

}  // namespace capstan::recording
