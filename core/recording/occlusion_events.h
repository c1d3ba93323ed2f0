#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Kind of the events that report which cameras are blocked deliberately.
inline constexpr const char* kOcclusionKind = "occlusion";
/// End of the text of an event whose occlusion was added to a source that is itself a recording.
inline constexpr const char* kAddedOcclusion = ", added to a recording";

/// Text of an event: the cameras that are blocked from now on, "free", "left blocked", "right blocked" or
/// "both blocked"; `added`: with kAddedOcclusion.
std::string occlusionText(const std::array<bool, 2>& blocked, bool added = false);

/// Meaning of such a text.
struct OcclusionEvent {
  std::array<bool, 2> blocked{};
  bool added = false;
};
/// Nothing for another text, such as the words of a schedule.
std::optional<OcclusionEvent> parseOcclusion(std::string_view text);

/// Deliberate occlusion of a session file, by its events. A simulated camera is blocked when it exposes.
/// Images of other sources are covered when they arrive.
class RecordedOcclusion {
 public:
  RecordedOcclusion() = default;
  /// `simulated`: the session was recorded from a simulation. Throws SqliteError.
  RecordedOcclusion(Database& database, bool simulated);
  /// Cameras, left and right, whose view was blocked in the frame with row number `seq` and stamp t [s].
  std::array<bool, 2> at(std::int64_t seq, double t) const;

 private:
  struct Change {
    std::int64_t seq = 0;
    double t = 0.0;
    OcclusionEvent event;
  };
  bool simulated_ = false;
  std::vector<Change> changes_;  ///< in the order of arrival
};

}  // namespace capstan::recording
