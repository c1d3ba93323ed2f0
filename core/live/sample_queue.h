#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "core/tracking/sample.h"

namespace capstan::live {

/// Samples on their way from the sides of a live source to tracking, in order of arrival.
class SampleQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// `capacity`: number of samples; `frames`: number of pairs of images among them.
  explicit SampleQueue(std::size_t capacity, std::size_t frames = 16)
      : capacity_(capacity), frame_capacity_(frames) {}

  /// False: the queue is full, and the sample is lost.
  bool offer(tracking::Sample&& sample) {
    const std::lock_guard lock(mutex_);
    if (samples_.size() >= capacity_ || (isFrame(sample) && frames_ >= frame_capacity_)) return false;
    push(std::move(sample));
    return true;
  }
  /// Waits for room instead. False: the queue was closed.
  bool wait(tracking::Sample&& sample) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return closed_ || samples_.size() < capacity_; });
    if (closed_) return false;
    push(std::move(sample));
    return true;
  }
  /// Ends the queue: what it holds can still be taken.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    come_.notify_all(), room_.notify_all();
  }
  /// Discards the pairs of images.
  void clearFrames() {
    const std::lock_guard lock(mutex_);
    std::erase_if(samples_, [](const Waiting& one) { return isFrame(one.sample); });
    frames_ = 0;
    room_.notify_all();
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    samples_.clear();
    frames_ = 0;
    room_.notify_all();
  }

  /// Time since the oldest sample was offered [s]; 0: the queue is empty, or nothing was taken so far.
  double backlog() const {
    const std::lock_guard lock(mutex_);
    if (samples_.empty() || !begun_) return 0.0;
    return std::chrono::duration<double>(Clock::now() - samples_.front().offered).count();
  }

  /// Waits up to `wait` until take() returns at once.
  bool ready(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    return come_.wait_for(lock, wait, [&] { return closed_ || !samples_.empty(); });
  }
  /// Waits for a sample, and returns when it was offered. Nothing: the queue is closed and empty.
  std::optional<Clock::time_point> take(tracking::Sample& out) {
    std::unique_lock lock(mutex_);
    come_.wait(lock, [&] { return closed_ || !samples_.empty(); });
    if (samples_.empty()) return {};
    begun_ = true;
    const Clock::time_point offered = samples_.front().offered;
    out = std::move(samples_.front().sample);
    samples_.pop_front();
    frames_ -= isFrame(out);
    room_.notify_one();
    return offered;
  }

 private:
  struct Waiting {
    tracking::Sample sample;
    Clock::time_point offered;
  };
  static bool isFrame(const tracking::Sample& sample) {
    return std::holds_alternative<tracking::StereoFrame>(sample);
  }
  void push(tracking::Sample&& sample) {
    frames_ += isFrame(sample);
    samples_.push_back({std::move(sample), Clock::now()});
    come_.notify_one();
  }

  const std::size_t capacity_, frame_capacity_;
  std::size_t frames_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable come_, room_;
  std::deque<Waiting> samples_;
  bool closed_ = false, begun_ = false;
};

}  // namespace capstan::live
