#include "core/recording/occlusion_events.h"

#include <algorithm>

#include "core/recording/schema.h"
#include "core/recording/session_reader.h"

namespace capstan::recording {

std::string occlusionText(const std::array<bool, 2>& blocked, bool added) {
  std::string text = blocked[0] && blocked[1] ? "both blocked"
                     : blocked[0]             ? "left blocked"
                     : blocked[1]             ? "right blocked"
                                              : "free";
  if (added) text += kAddedOcclusion;
  return text;
}

std::optional<OcclusionEvent> parseOcclusion(std::string_view text) {
  for (const bool added : {false, true})
    for (const bool left : {false, true})
      for (const bool right : {false, true})
        if (text == occlusionText({left, right}, added)) return OcclusionEvent{{left, right}, added};
  return std::nullopt;
}

RecordedOcclusion::RecordedOcclusion(Database& database, bool simulated) : simulated_(simulated) {
  Statement rows = rowsOf(database, table(kEventTable));
  while (rows.step()) {
    if (rows.text(2) != kOcclusionKind) continue;
    if (const auto event = parseOcclusion(rows.text(3)))
      changes_.push_back({rows.integer(0), rows.real(1), *event});
  }
}

std::array<bool, 2> RecordedOcclusion::at(std::int64_t seq, double t) const {
  const auto before = [&](const Change& change) {
    return simulated_ && !change.event.added ? change.t < t : change.seq < seq;
  };
  const auto last = std::find_if(changes_.rbegin(), changes_.rend(), before);
  return last == changes_.rend() ? std::array<bool, 2>{} : last->event.blocked;
}

}  // namespace capstan::recording
