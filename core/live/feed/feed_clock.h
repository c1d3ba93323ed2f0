#pragma once

#include <chrono>
#include <cstdint>

namespace capstan::live {

/// The machine's steady clock [ns], which all its processes share.
inline std::int64_t feedNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

inline constexpr std::chrono::milliseconds kFeedBeat{100};  ///< period of a writer's heartbeat
inline constexpr std::chrono::milliseconds kFeedSilence{
    2000};  ///< without a heartbeat for so long: the writer is dead

}  // namespace capstan::live
