#pragma once

#include <chrono>
#include <mutex>
#include <vector>

#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"

namespace capstan::live {

/// Passes results of the pipeline's thread to the threads of views: newest snapshot, newest frames, history
/// for plots. Both sides hold the lock only to copy a few hundred bytes or to swap images.
class Publisher {
 public:
  /// The history holds at most `capacity` snapshots; new ones replace the oldest.
  explicit Publisher(std::size_t capacity);

  // The pipeline's thread.
  void publish(const tracking::Snapshot& snapshot, bool into_history);
  /// Publishes a frame and its snapshot; copies the images outside the lock.
  void publish(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot);
  /// The same at most every kImagePeriod, except if the last published frames were taken: for runs that are
  /// faster than any view.
  void publishSometimes(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot);

  // Any other thread.
  bool takeSnapshot(tracking::Snapshot& out);
  bool takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen);
  std::size_t drainHistory(std::vector<tracking::Snapshot>& out);

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kImagePeriod = std::chrono::milliseconds(30);
  bool framesTaken() const;

  mutable std::mutex mutex_;
  tracking::Snapshot newest_;
  bool fresh_ = false;
  std::vector<tracking::Snapshot> history_;  ///< ring
  std::size_t first_ = 0, count_ = 0;
  tracking::StereoFrame frames_;
  tracking::Snapshot frames_seen_;
  bool frames_fresh_ = false;
  Clock::time_point published_{};  ///< frames; the pipeline's thread
  tracking::StereoFrame back_;     ///< the pipeline's thread fills it, then swaps
};

}  // namespace capstan::live
