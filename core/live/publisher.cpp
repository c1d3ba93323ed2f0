#include "core/live/publisher.h"

#include <algorithm>
#include <utility>

namespace capstan::live {

Publisher::Publisher(std::size_t capacity) : history_(std::max<std::size_t>(capacity, 1)) {}

void Publisher::publish(const tracking::Snapshot& snapshot, bool into_history) {
  const std::lock_guard lock(mutex_);
  newest_ = snapshot;
  fresh_ = true;
  if (!into_history) return;
  history_[(first_ + count_) % history_.size()] = snapshot;
  if (count_ < history_.size())
    ++count_;
  else
    first_ = (first_ + 1) % history_.size();
}

void Publisher::publishSometimes(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot) {
  if (framesTaken() || Clock::now() - published_ >= kImagePeriod) publish(frame, snapshot);
}

void Publisher::publish(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot) {
  published_ = Clock::now();
  back_.t = frame.t;
  back_.t_arrival = frame.t_arrival;
  back_.skew = frame.skew;
  back_.blocked = frame.blocked;
  frame.left.copyTo(back_.left);
  frame.right.copyTo(back_.right);
  const std::lock_guard lock(mutex_);
  std::swap(back_, frames_);
  frames_seen_ = snapshot;
  frames_fresh_ = true;
}

bool Publisher::framesTaken() const {
  const std::lock_guard lock(mutex_);
  return !frames_fresh_;
}

bool Publisher::takeSnapshot(tracking::Snapshot& out) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(fresh_, false)) return false;
  out = newest_;
  return true;
}

bool Publisher::takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen) {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(frames_fresh_, false)) return false;
  std::swap(out, frames_);
  if (seen) *seen = frames_seen_;
  return true;
}

std::size_t Publisher::drainHistory(std::vector<tracking::Snapshot>& out) {
  const std::lock_guard lock(mutex_);
  const std::size_t drained = count_;
  for (; count_ > 0; --count_) {
    out.push_back(history_[first_]);
    first_ = (first_ + 1) % history_.size();
  }
  return drained;
}

}  // namespace capstan::live
