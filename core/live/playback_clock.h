#pragma once

#include <algorithm>
#include <chrono>

namespace capstan::live {

/// Computes the wall time at which a sample is due, for a playback speed. Time comes in as an argument.
class PlaybackClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes the next sample the origin, after a pause, a step or a change of speed.
  void restart() { running_ = false; }

  /// Wall time at which the sample of recording time `t` [s] is due at `speed` (> 0). A playback that is more
  /// than kSlip late does not catch up; real_time_factor then shows the lower speed.
  Clock::time_point due(double t, double speed, Clock::time_point now) {
    if (!running_ || t < origin_t_) start(t, now);
    auto when = origin_ + seconds((t - origin_t_) / speed);
    if (now - when > seconds(kSlip)) {
      start(t, now);
      when = now;
    }
    return when;
  }

 private:
  static constexpr double kSlip = 0.25;  // [s]

  static Clock::duration seconds(double value) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
  }
  void start(double t, Clock::time_point now) {
    running_ = true;
    origin_t_ = t;
    origin_ = now;
  }

  bool running_ = false;
  double origin_t_ = 0.0;
  Clock::time_point origin_;
};

}  // namespace capstan::live
