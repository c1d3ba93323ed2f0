#pragma once

#include <array>
#include <string>

#include "core/base/names.h"

namespace capstan::live {

enum class BlockedCameras { kBoth, kLeft, kRight };

/// Schedule that blocks the cameras for `percentage` of the time, in equally spaced intervals of `interval`
/// seconds (UKF paper, section V-D: 10, 20, 40, 60 and 80 % in intervals of 2 s). The period is interval /
/// share; it begins with visible cameras.
struct OcclusionSchedule {
  double percentage = 0.0;  ///< 0…100; 0: never
  double interval = 2.0;    ///< [s]
  double start = 0.0;       ///< start of the first period [s]
  BlockedCameras cameras = BlockedCameras::kBoth;

  bool blockedAt(double t) const;
  /// Share of [0, t] that the schedule blocks, 0…1.
  double shareUntil(double t) const;
};

/// Description for people: "both cameras blocked 40 % of the time, in intervals of 2.0 s", "left camera …",
/// or "no schedule".
std::string scheduleWords(const OcclusionSchedule& schedule);

}  // namespace capstan::live

template <>
struct capstan::base::NamesOf<capstan::live::BlockedCameras> {
  using B = capstan::live::BlockedCameras;
  static constexpr std::array value = {std::pair{B::kBoth, "both"}, std::pair{B::kLeft, "left"},
                                       std::pair{B::kRight, "right"}};
};
