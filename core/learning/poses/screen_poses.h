#pragma once

#include <array>
#include <span>

#include "core/learning/poses/pose_motion.h"

namespace capstan::learning {

/// An excluded row of one stream.
struct RejectedRow {
  StreamKind stream = StreamKind::kCamera;
  std::size_t motion = 0;  ///< index of the motion
  std::size_t row = 0;     ///< line of the file
  Reason reason = Reason::kNone;
};

struct ScreenReport {
  std::vector<PoseMotion> motions;  ///< one per given motion; streams may be empty
  std::array<std::size_t, kStreams> rows{}, poses{};
  std::vector<RejectedRow> rejected;
  std::size_t count(StreamKind stream, Reason reason) const;
};

/// Selects valid poses: finite, with a unit quaternion (norm within kNorm of 1), no placeholder (position 0
/// and quaternion (0, 0, 0, ±1), or all 0), and later than the previous one. Every excluded row is listed.
ScreenReport screenPoses(std::span<const RawMotion> motions);
inline constexpr double kNorm = 0.01;

}  // namespace capstan::learning
