#pragma once

#include <array>
#include <span>

#include "core/learning/poses/pose_motion.h"

namespace capstan::learning {

/// A row of one stream that is excluded.
struct RejectedRow {
  StreamKind stream = StreamKind::kCamera;
  std::size_t motion = 0;  ///< place among the motions
  std::size_t row = 0;     ///< line of the file
  Reason reason = Reason::kNone;
};

struct ScreenReport {
  std::vector<PoseMotion> motions;  ///< as many as given, some streams perhaps empty
  std::array<std::size_t, kStreams> rows{}, poses{};
  std::vector<RejectedRow> rejected;
  std::size_t count(StreamKind stream, Reason reason) const;
};

/// Poses that are ones: finite, with a unit quaternion (its norm within kNorm of 1), no placeholder (position
/// 0 and quaternion (0, 0, 0, ±1), or all 0), each later than the one before. Every row that is excluded is
/// listed.
ScreenReport screenPoses(std::span<const RawMotion> motions);
inline constexpr double kNorm = 0.01;

}  // namespace capstan::learning
