#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <thread>

#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Moves a growing write-ahead log into its database on a thread of its own, so that the writer's commits
/// never wait for a sync of the disk (up to 0.6 s and more beside video).
///
/// The writer runs with synchronous = OFF: a commit is a write() to the operating system, which survives the
/// process. This thread owes the syncs: each passive checkpoint syncs the log, copies its pages and syncs the
/// database, and when the writer has begun the log again, this thread syncs its first page, so that a loss of
/// power finds either log whole. A log that is copied completely between two commits is restarted by the
/// next one; that bounds it near `threshold` as long as the disk follows. Its checkpoints never shorten the
/// main file, where the writer has made room for pages that are still in the log.
class Checkpointer {
 public:
  Checkpointer(const std::filesystem::path& path, std::uint64_t threshold);
  ~Checkpointer();
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;

  /// From now on the commits of `writer` report the length of the log.
  void watch(Database& writer);
  /// After a commit: looks whether there is work. Does not wait.
  void wake();
  /// Ends the thread; a checkpoint under way is finished first. Idempotent.
  void stop();

  std::uint64_t logBytes() const { return pages_.load(std::memory_order_relaxed) * page_bytes_; }

 private:
  static int onCommit(void* self, sqlite3* database, const char* name, int pages);
  void work();
  /// Checkpoints over `database` no longer cut the main file down to the pages copied so far.
  void keepLengthOf(Database& database);
  void checkpoint(Database& database);
  void syncLog();

  const std::filesystem::path path_;
  const std::uint64_t threshold_;
  sqlite3_io_methods methods_{};  ///< of this thread's main file: all of the VFS but truncation
  std::uint64_t page_bytes_ = 0;
  std::atomic<std::uint64_t> pages_{0};
  std::atomic<bool> restarted_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool due_ = false, stopping_ = false;
  std::thread thread_;
};

}  // namespace capstan::recording
