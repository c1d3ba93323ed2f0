#pragma once

#include <chrono>
#include <cstdint>

namespace capstan::live {

/// Measures the rates of motor and camera samples (per second of recording) and the actual playback speed,
/// over windows of about one second of wall time.
class RateMeter {
 public:
  using Clock = std::chrono::steady_clock;

  void restart() { running_ = false; }
  void count(bool motor, bool camera) {
    motors_ += motor;
    cameras_ += camera;
  }

  /// Ends the window if it is long enough; `t` is the current recording time [s].
  void look(double t, Clock::time_point now) {
    if (!running_ || t < begin_t_) return begin(t, now);  // or the clock was set back
    const double wall = std::chrono::duration<double>(now - begin_).count();
    const double recorded = t - begin_t_;
    if (wall < kWindow || recorded <= 0.0) return;
    motor_rate_ = static_cast<double>(motors_) / recorded;
    camera_rate_ = static_cast<double>(cameras_) / recorded;
    real_time_factor_ = recorded / wall;
    begin(t, now);
  }

  double motorRate() const { return motor_rate_; }
  double cameraRate() const { return camera_rate_; }
  double realTimeFactor() const { return real_time_factor_; }

 private:
  static constexpr double kWindow = 0.95;  // [s]

  void begin(double t, Clock::time_point now) {
    running_ = true;
    begin_ = now;
    begin_t_ = t;
    motors_ = cameras_ = 0;
  }

  bool running_ = false;
  Clock::time_point begin_;
  double begin_t_ = 0.0;
  std::uint64_t motors_ = 0, cameras_ = 0;
  double motor_rate_ = 0.0, camera_rate_ = 0.0, real_time_factor_ = 0.0;
};

}  // namespace capstan::live
