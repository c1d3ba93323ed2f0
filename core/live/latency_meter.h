#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>

#include "core/tracking/source.h"

namespace capstan::live {

/// Median and 99 % quantile (nearest rank) of the newest kWindow latencies. Any thread may call it.
class LatencyMeter {
 public:
  static constexpr std::size_t kWindow = 4096;

  void add(std::chrono::duration<double> latency) {
    const std::lock_guard lock(mutex_);
    newest_[count_++ % kWindow] = latency.count();
  }
  std::optional<tracking::SideLatency> latency() const {
    std::array<double, kWindow> values;
    std::size_t size = 0;
    {
      const std::lock_guard lock(mutex_);
      size = std::min(count_, kWindow);
      std::copy_n(newest_.begin(), size, values.begin());
    }
    if (size == 0) return {};
    const auto rank = [&](double share) {
      const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(size - 1));
      std::nth_element(values.begin(), at, values.begin() + static_cast<std::ptrdiff_t>(size));
      return *at;
    };
    const double median = rank(0.5);
    return tracking::SideLatency{median, rank(0.99)};
  }

 private:
  mutable std::mutex mutex_;
  std::array<double, kWindow> newest_{};
  std::size_t count_ = 0;
};

}  // namespace capstan::live
