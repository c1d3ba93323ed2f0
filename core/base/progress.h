#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>

namespace capstan::base {

/// Progress of long work, and the request to cancel it. Written by the worker, read by any other
/// thread.
class Progress {
 public:
  /// `fraction` of the whole in [0, 1]; `doing` is a short present-tense phrase.
  void report(double fraction, std::string_view doing) {
    fraction_.store(fraction, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    doing_.assign(doing);
  }
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }

  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  std::string doing() const {
    const std::lock_guard lock(mutex_);
    return doing_;
  }

 private:
  std::atomic<bool> cancelled_{false};
  std::atomic<double> fraction_{0.0};
  mutable std::mutex mutex_;
  std::string doing_;
};

}  // namespace capstan::base
