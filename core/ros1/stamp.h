#pragma once

#include <cmath>
#include <cstdint>

namespace capstan::ros1 {

inline constexpr std::int64_t kSecond = 1000000000;  // [ns]

/// Nearest nanosecond of a time [s], and back. Long double keeps both exact to the nanosecond up to 1e9 s.
inline std::int64_t nanosecondsOf(double t) {
  return static_cast<std::int64_t>(std::llroundl(static_cast<long double>(t) * 1e9L));
}
inline double secondsOf(std::int64_t nanoseconds) {
  return static_cast<double>(static_cast<long double>(nanoseconds) / 1e9L);
}

}  // namespace capstan::ros1
