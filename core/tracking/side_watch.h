#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/tracking/source.h"

namespace capstan::tracking {

/// Notices what changes at the sides of a live source: for a log, and for the events of a recording.
class SideWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Sentences about what has changed since the last call, as "motors silent" or "motors receiving again
  /// after 2.1 s". Without a change: none.
  std::vector<std::string> observe(const std::vector<SideStatus>& sides,
                                   Clock::time_point now = Clock::now());
  /// The next call of observe() states the present state of every side: for a recording that begins.
  void restate() { restate_ = true; }

  /// Images are dated otherwise when this has lasted for so long: stamps that hardly agree change often.
  static constexpr std::chrono::milliseconds kLasting{500};

 private:
  struct Seen {
    SideStatus::State state = SideStatus::State::kWaiting;
    std::string part, fault, reason;
    std::uint64_t steps = 0, received = 0, refused = 0, incomplete = 0, gaps = 0;
    std::string encoders, warning;
    std::vector<std::string> notices;
    std::optional<SideStatus::Times> times;        ///< that were said last
    std::optional<Clock::time_point> other_since;  ///< since when they are others
    double silent_for = 0.0;                       ///< longest time in the present silence [s]
  };
  std::vector<Seen> seen_;
  bool restate_ = false;
};

}  // namespace capstan::tracking
