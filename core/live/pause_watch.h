#pragma once

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace capstan::live {

/// Notices when a live session is paused and when it runs again: for a log, and for the events of a
/// recording.
class PauseWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// `sender_waits`: no row is discarded during a pause.
  explicit PauseWatch(bool sender_waits = false) : sender_waits_(sender_waits) {}

  /// A sentence, or nothing. `t`: time of the newest sample [s]; the session runs again with the first sample
  /// after the pause. A session that has not run yet is not paused.
  std::optional<std::string> observe(bool paused, double t, Clock::time_point now) {
    if (!paused && !paused_at_) has_run_ = true;
    if (paused && !has_run_) return {};
    if (paused) {
      if (!paused_at_) since_ = now, paused_at_ = t;
      if (std::exchange(said_, true)) return {};
      return sender_waits_ ? "paused: the sender of the rows waits, images are discarded"
                           : "paused: samples that come are discarded";
    }
    if (!paused_at_ || t == *paused_at_) return {};
    paused_at_.reset();
    said_ = false;
    return fmt::format("running again after {:.1f} s", std::chrono::duration<double>(now - since_).count());
  }
  /// observe() says again that the session is paused, if it is: for a recording that begins.
  void restate() { said_ = false; }

 private:
  bool sender_waits_, has_run_ = false, said_ = false;
  std::optional<double> paused_at_;  ///< time of the newest sample before the pause [s]; nothing: it runs
  Clock::time_point since_{};
};

}  // namespace capstan::live
