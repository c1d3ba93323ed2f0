#include "core/live/occlusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace capstan::live {
bool OcclusionSchedule::blockedAt(double t) const {
  const double share = std::clamp(percentage, 0.0, 100.0) / 100.0;
  if (share == 0.0 || interval <= 0.0 || t < start) return false;
  const double period = interval / share;
  return std::fmod(t - start, period) >= period - interval;
}

double OcclusionSchedule::shareUntil(double t) const {
  const double share = std::clamp(percentage, 0.0, 100.0) / 100.0;
  if (share == 0.0 || interval <= 0.0 || t <= start) return 0.0;
  const double period = interval / share;
  const double whole = std::floor((t - start) / period);
  const double rest = (t - start) - whole * period;
  return (whole * interval + std::max(0.0, rest - (period - interval))) / t;
}

std::string scheduleWords(const OcclusionSchedule& schedule) {
  if (schedule.percentage <= 0.0) return "no schedule";
  return fmt::format("{} blocked {:.0f} % of the time, in intervals of {:.1f} s",
                     schedule.cameras == BlockedCameras::kBoth
                         ? "both cameras"
                         : fmt::format("{} camera", base::nameOf(schedule.cameras)),
                     schedule.percentage, schedule.interval);
}

}  // namespace capstan::live
