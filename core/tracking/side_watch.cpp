#include "core/tracking/side_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/tracking/side_text.h"

namespace capstan::tracking {
namespace {

using State = SideStatus::State;

/// The side's state in words; `changed`: just now.
std::string sentenceOf(const SideStatus& side, double silent_for, bool changed) {
  if (side.state == State::kReceiving)
    return silent_for > 0.0 ? fmt::format("{} receiving again after {:.1f} s", side.name, silent_for)
                            : side.name + " receiving";
  if (changed && (side.state == State::kSilent || side.state == State::kFrozen)) return stateOf(side);
  return shortTextOf(side);
}

/// By what images are dated; `before`: by what they were.
std::string timesText(const SideStatus& side, std::optional<SideStatus::Times> before) {
  return fmt::format("{}: times of the images by {}{}", side.name, base::nameOf(*side.times),
                     before ? fmt::format(", no longer by {}", base::nameOf(*before)) : "");
}

}  // namespace

std::vector<std::string> SideWatch::observe(const std::vector<SideStatus>& sides, Clock::time_point now) {
  std::vector<std::string> sentences;
  seen_.resize(sides.size());
  const bool restated = std::exchange(restate_, false);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const SideStatus& side = sides[k];
    Seen& seen = seen_[k];
    // A program that connects again at once leaves no time to see the state. What is refused again and again,
    // such as every message of a topic, is said once.
    const bool again = side.fault == seen.fault && side.received == seen.received;
    if (side.refused > seen.refused && (side.state != State::kRefused || seen.state == State::kRefused) &&
        !again)
      sentences.push_back(fmt::format("{} refused: {}", side.name, side.fault));
    const bool nothing_comes = side.state == State::kWaiting || side.state == State::kSilent;
    const bool new_reason = nothing_comes && !side.reason.empty() && side.reason != seen.reason;
    const bool changed = side.state != seen.state || side.part != seen.part || new_reason;
    if (changed || restated)
      sentences.push_back(sentenceOf(side, seen.received > 0 ? seen.silent_for : 0.0, changed));
    if (side.clock && side.clock->steps > seen.steps)
      sentences.push_back(fmt::format("{}: clock stepped by {:+.3f} s", side.name, side.clock->last_step));
    if (side.times == seen.times)
      seen.other_since.reset();
    else if (!seen.other_since)
      seen.other_since = now;
    const bool lasting = seen.other_since && now - *seen.other_since >= kLasting;
    if (side.times && (lasting || restated)) {
      sentences.push_back(timesText(side, restated ? std::nullopt : seen.times));
      seen.times = side.times, seen.other_since.reset();
    }
    // The end of a silence that was said is no news.
    if (side.gaps > seen.gaps && seen.state == State::kReceiving && side.state == State::kReceiving)
      sentences.push_back(
          fmt::format("{}: gap of {:.1f} s in the times of the {}s", side.name, side.last_gap, side.counted));
    seen.gaps = side.gaps;
    if (side.incomplete > seen.incomplete)
      sentences.push_back(side.name + ": the last row was incomplete, and is excluded");
    seen.incomplete = side.incomplete;
    if (side.notices != seen.notices || restated)
      for (const std::string& notice : side.notices)
        sentences.push_back(fmt::format("{}: {}", side.name, notice));
    seen.notices = side.notices;
    if (!side.warning.empty() && (side.warning != seen.warning || restated))
      sentences.push_back(fmt::format("{}: {}", side.name, side.warning));
    seen.warning = side.warning;
    const std::string encoders = encodersText(side);
    if (encoders != seen.encoders || (restated && !encoders.empty()))
      sentences.push_back(encoders.empty() ? side.name + ": joint encoders are used" : encoders);
    seen.encoders = encoders;
    seen.silent_for = side.state == State::kReceiving ? 0.0 : std::max(seen.silent_for, side.silent_for);
    seen.state = side.state, seen.part = side.part, seen.received = side.received;
    seen.refused = side.refused, seen.fault = side.fault, seen.reason = side.reason;
    seen.steps = side.clock ? side.clock->steps : 0;
  }
  return sentences;
}

}  // namespace capstan::tracking
