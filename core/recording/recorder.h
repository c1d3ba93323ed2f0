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
  double buffered_time = 3.0;    ///< what the queue holds at the rates below [s], at least 2
  double motor_rate = 1000.0;    ///< expected motor, joint and estimate rows a second, each
  double frame_rate = 15.0;      ///< expected pairs of frames a second
  int width = 640,
      height = 480;  ///< of the frames [px]; other sizes are stored too, at the cost of an allocation
  /// Log size that starts moving it into the main file; on a small disk a 32nd of it.
  std::uint64_t checkpoint_bytes = 64U << 20;
  std::uint64_t max_bytes = 0;  ///< largest file; 0: what the disk holds
  /// Recording stops before the disk has less than this; none: DiskSpace::reserve of the disk.
  std::optional<std::uint64_t> min_free_bytes;
  /// Reports the free space of the file's disk; tests replace it.
  std::function<DiskSpace(const std::filesystem::path& folder)> disk_space = diskSpaceAt;
  std::function<void()>
      before_commit;  ///< runs on the writer's thread before each commit; tests stall it here
};

enum class RecorderState { kRecording, kFailed, kClosed };

struct RecorderStats {
  RecorderState state = RecorderState::kRecording;
  std::string error;                 ///< why it failed and what to do; empty while it did not
  std::uint64_t queued = 0;          ///< samples and estimates taken
  std::uint64_t written = 0;         ///< of these, committed
  std::uint64_t dropped = 0;         ///< refused because the queue was full or the recorder had failed
  std::uint64_t dropped_frames = 0;  ///< of these, pairs of frames
  std::uint64_t frames = 0;          ///< pairs of frames committed
  std::uint64_t bytes = 0;           ///< of all rows committed, as stored
  std::uint64_t lost = 0;            ///< taken and not in the file: the fault came before their commit
  double lost_time = 0.0;            ///< age of the oldest of these at the fault [s]
  std::uint64_t free_bytes = 0;      ///< on the disk of the file
  bool free_known = false;           ///< the system says how much that is
  std::uint64_t reserve_bytes = 0;   ///< recording stops before less is free
  double time_left = 0.0;            ///< until then at the present rate [s]; 0: not known yet
  std::uint64_t log_bytes = 0;       ///< write-ahead log not yet in the main file
  double worst_commit = 0.0;         ///< longest commit [s]
  double worst_backlog = 0.0;        ///< oldest row at its commit: from offer to commit [s]
  double encode_time = 0.0;          ///< processor time of frame encoding, mean a frame [s]
};

/// Writes a session file. offer() copies into a bounded queue and returns: it never waits for the disk and
/// does not allocate. A writer thread encodes and commits; when the disk cannot follow and the queue is full,
/// what is offered is dropped and counted. Committed rows survive the death of the process, and the file
/// stays whole through a loss of power (SQLite's write-ahead log with checkpoints off the writer's thread).
///
/// A fault ends the recording: the log is moved into the file, which is closed before stats() reports the
/// fault, so that the one file copied alone holds all that was committed. A full disk does not prevent that:
/// whatever is in the log has its room in the main file already. Before the disk is full, when only the
/// reserve is free, recording stops with every row that was taken.
class Recorder {
 public:
  /// Creates `path`, an existing file is refused. Throws base::InputError when it cannot be created or only
  /// the reserve is free there.
  Recorder(const std::filesystem::path& path, const SessionHeader& header,
           const RecorderOptions& options = {});
  /// close()
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// One thread offers. False: dropped.
  bool offer(const tracking::Sample& sample);
  bool offer(const tracking::Snapshot& snapshot);
  /// Any thread; rare. Never dropped while recording.
  void note(double t, std::string kind, std::string text);
  /// Stores a registration made while recording, as header entry and event.
  void setRegistration(double t, const Eigen::Isometry3d& base_from_camera);

  /// Writes what is queued, moves the log into the file and ends the thread. Idempotent.
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
