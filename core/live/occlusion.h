#pragma once

#include <string>

namespace capstan::live {

/// Cameras blocked for `percentage` of the time, in intervals of `interval` seconds at equal spacing (UKF
/// paper, section V-D: 10, 20, 40, 60 and 80 % in intervals of 2 s). The period is interval / share; it
/// begins with observation.
struct OcclusionSchedule {
  double percentage = 0.0;  ///< 0…100; 0: never
  double interval = 2.0;    ///< [s]
  double start = 0.0;       ///< first period begins here [s]

  bool blockedAt(double t) const;
  /// Blocked share of [0, t] that the schedule has brought by t, 0…1.
  double shareUntil(double t) const;
};

/// "both cameras blocked 40 % of the time, in intervals of 2.0 s", or "no schedule".
std::string scheduleWords(const OcclusionSchedule& schedule);

}  // namespace capstan::live
