#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/recording/disk_space.h"
#include "core/recording/session_file.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"

namespace capstan::recording {

struct RecorderOptions {
  double commit_interval = 0.1;  ///< longest time between commits [s], at most 0.2
  double buffered_time = 3.0;    ///< time that the queue holds at the rates below [s], at least 2
  double motor_rate = 1000.0;    ///< expected rate of motor, joint and estimate rows, each [1/s]
  double frame_rate = 15.0;      ///< expected rate of pairs of frames [1/s]
  /// Expected size of the frames [px]; other sizes are stored too, at the cost of an allocation.
  int width = 640, height = 480;
  /// Log size from which the log is moved into the main file [bytes]; on a small disk 1/32 of the disk.
  std::uint64_t checkpoint_bytes = 64U << 20;
  bool wait = false;            ///< offer() waits while a queue is full, instead of dropping
  std::uint64_t max_bytes = 0;  ///< largest file size [bytes]; 0: limited by the disk
  /// Free space that recording leaves on the disk [bytes]; none: DiskSpace::reserve of the disk.
  std::optional<std::uint64_t> min_free_bytes;
  /// Reports the free space of the file's disk; tests replace it.
  std::function<DiskSpace(const std::filesystem::path& folder)> disk_space = diskSpaceAt;
  /// Runs on the writer's thread before each commit; tests block the writer here.
  std::function<void()> before_commit;
};

enum class RecorderState { kRecording, kFailed, kClosed };

struct RecorderStats {
  RecorderState state = RecorderState::kRecording;
  std::string error;                 ///< reason of a failure and its remedy; empty without failure
  std::uint64_t queued = 0;          ///< number of samples and estimates taken
  std::uint64_t written = 0;         ///< number of these that are committed
  std::uint64_t dropped = 0;         ///< number not taken, because the queue was full or recording had failed
  std::uint64_t dropped_frames = 0;  ///< number of these that are pairs of frames
  std::uint64_t frames = 0;          ///< number of pairs of frames committed
  std::uint64_t bytes = 0;           ///< stored size of all committed rows
  std::uint64_t lost = 0;  ///< number taken but not in the file, because the fault came before their commit
  double lost_time = 0.0;  ///< age of the oldest of these at the fault [s]
  std::uint64_t free_bytes = 0;     ///< free space on the disk of the file
  bool free_known = false;          ///< the system reports the free space
  std::uint64_t reserve_bytes = 0;  ///< free space that recording leaves
  double time_left = 0.0;           ///< time until then at the present growth rate [s]; 0: not known
  std::uint64_t log_bytes = 0;      ///< size of the write-ahead log that is not yet in the main file
  double worst_commit = 0.0;        ///< longest commit [s]
  double worst_backlog = 0.0;       ///< longest time of a row from offer to commit [s]
  double encode_time = 0.0;         ///< mean processor time for encoding a frame [s]
};

/// Sentence for people on a recording of which `missing` samples were dropped or lost, with the remedy.
std::string gapsText(std::uint64_t missing);

/// Writes a session file. offer() copies into a bounded queue and returns: it never waits for the disk and
/// does not allocate. A writer thread encodes and commits. When the disk is too slow and the queue is full,
/// offered samples are dropped and counted. Committed rows survive a crash of the process, and the file stays
/// consistent after a loss of power (SQLite's write-ahead log with checkpoints on another thread).
///
/// A fault ends the recording: the log is moved into the file, and the file is closed before stats() reports
/// the fault. The file alone then contains all committed rows, also on a full disk, because the main file has
/// already reserved room for the log. When only the reserve of the disk is free, recording stops, and every
/// row taken so far is in the file.
class Recorder {
 public:
  /// Creates `path`. Throws base::InputError if the file exists or cannot be created, if only the reserve is
  /// free there, or if the memory for the images is not available.
  Recorder(const std::filesystem::path& path, const SessionHeader& header,
           const RecorderOptions& options = {});
  /// Calls close().
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Offers a sample or snapshot; always from the same thread. False: dropped.
  bool offer(const tracking::Sample& sample);
  bool offer(const tracking::Snapshot& snapshot);
  /// Stores an event (infrequent). Any thread may call it. It is never dropped while recording.
  void note(double t, std::string kind, std::string text);
  /// Stores a registration made while recording, as header entry and event.
  void setRegistration(double t, const Eigen::Isometry3d& base_from_camera);
  /// Stores marker options (YAML) chosen while recording, as header entry; the event has their time.
  void setMarker(double t, const std::string& marker);

  /// Writes the queued rows, moves the log into the file, ends the thread and releases the memory of the
  /// images. No offer() of another thread may be under way or follow. Idempotent.
  void close();

  RecorderStats stats() const;  ///< any thread
  const std::filesystem::path& path() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::recording

template <>
struct capstan::base::NamesOf<capstan::recording::RecorderState> {
  using S = capstan::recording::RecorderState;
  static constexpr std::array value = {std::pair{S::kRecording, "recording"}, std::pair{S::kFailed, "failed"},
                                       std::pair{S::kClosed, "closed"}};
};
