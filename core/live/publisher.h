#pragma once

#include <mutex>
#include <vector>

#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"

namespace capstan::live {

/// Hands what the pipeline's thread makes to the threads of views: newest snapshot, newest frames, history
/// for plots. Both sides hold the lock for a copy of a few hundred bytes or a swap of images.
class Publisher {
 public:
  /// At most `capacity` snapshots wait in the history; then the oldest make room.
  explicit Publisher(std::size_t capacity);

  // The pipeline's thread.
  void publish(const tracking::Snapshot& snapshot, bool into_history);
  /// Copies the images outside the lock; `snapshot` is what the pipeline made of them.
  void publish(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot);
  bool framesTaken() const;  ///< since the last publication

  // Any other thread.
  bool takeSnapshot(tracking::Snapshot& out);
  bool takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen);
  std::size_t drainHistory(std::vector<tracking::Snapshot>& out);

 private:
  mutable std::mutex mutex_;
  tracking::Snapshot newest_;
  bool fresh_ = false;
  std::vector<tracking::Snapshot> history_;  ///< ring
  std::size_t first_ = 0, count_ = 0;
  tracking::StereoFrame frames_;
  tracking::Snapshot frames_seen_;
  bool frames_fresh_ = false;
  tracking::StereoFrame back_;  ///< the pipeline's thread fills it, then swaps
};

}  // namespace capstan::live
