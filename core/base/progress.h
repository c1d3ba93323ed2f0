#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>

namespace capstan::base {

/// Progress of long work, and the request to cancel it. The worker calls report(); any other thread may read
/// the progress or call cancel().
class Progress {
 public:
  /// Sets the finished `fraction` in [0, 1] of the whole work and `doing`, a short phrase in present tense.
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
