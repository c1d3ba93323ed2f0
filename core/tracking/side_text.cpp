#include "core/tracking/side_text.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace capstan::tracking {
namespace {

using State = SideStatus::State;

std::string counted(std::uint64_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// Numbers of data that were lost or excluded so far, "3 missing, 12 dropped"; empty: none. The pairs of
/// images from before their times are known are not among them: every session has some.
std::string countsText(const SideStatus& side) {
  const std::pair<std::uint64_t, const char*> counts[] = {{side.missing, "missing"},
                                                          {side.repeated, "repeated"},
                                                          {side.dropped, "dropped"},
                                                          {side.unpaired, "unpaired"},
                                                          {side.frozen, "frozen"}};
  std::string text;
  for (const auto& [count, what] : counts)
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  return text;
}

bool isBehind(const SideStatus& side) { return side.backlog > SideStatus::kLongBacklog; }

/// Why joint encoders are not used, and the remedy; empty: they are used.
std::string whyNotUsed(const EncoderStatus& encoders) {
  switch (encoders.state) {
    case EncoderStatus::State::kOtherStamps:
      return "joint encoders are not used, their stamps differ from those of the motors: publish both with "
             "the stamp of one cycle, or leave out encoders in the live set-up";
    case EncoderStatus::State::kLate:
      return fmt::format(
          "joint encoders are not used, they come later than their motors by more than {} ms: publish both "
          "in "
          "one cycle, or leave out encoders in the live set-up",
          EncoderStatus::kWait.count());
    case EncoderStatus::State::kSilent:
      return fmt::format(
          "no joint encoders from {}: {}, or leave out encoders in the live set-up", encoders.from,
          encoders.reason.empty() ? "check that this topic is published with three finite positions"
                                  : encoders.reason);
    case EncoderStatus::State::kUsed:
      break;
  }
  return {};
}

/// The first seconds say nothing about a drift: a clock of a computer is within 1000 ppm.
std::string driftText(const SideClock& clock) {
  constexpr double kKnown = 1e-3, kMost = 1.99e-4;  // two quartz clocks, each within 100 ppm
  if (clock.drift_sigma > kKnown) return "drift not known yet";
  if (std::abs(clock.drift) > kMost) return "drift not known: samples come at another pace than their times";
  return fmt::format("drift {:.2f} ± {:.2f} ppm", 1e6 * clock.drift, 1e6 * clock.drift_sigma);
}

}  // namespace

std::string stateOf(const SideStatus& side, const std::string& how_long) {
  return fmt::format("{} {}{}{}", side.part.empty() ? side.name : side.part + " camera",
                     base::nameOf(side.state), how_long, side.reason.empty() ? "" : ": " + side.reason);
}

bool needsAttention(const SideStatus& side) {
  if (isBehind(side) || !side.warning.empty()) return true;
  if (side.state == State::kWaiting) return side.received > 0 || side.refused > 0;
  return side.state == State::kSilent || side.state == State::kFrozen || side.state == State::kRefused ||
         side.state == State::kEnded;
}

std::string shortTextOf(const SideStatus& side) {
  switch (side.state) {
    case State::kWaiting:
      if (side.refused > 0 && side.received == 0)
        return fmt::format("{} refused {}: {}", side.name, counted(side.refused, "time"), side.fault);
      if (side.connected) return fmt::format("{}: connected at {}, no valid row yet", side.name, side.from);
      return side.reason.empty() ? fmt::format("{}: waiting at {}", side.name, side.from)
                                 : fmt::format("{}: waiting: {}", side.name, side.reason);
    case State::kSilent:
    case State::kFrozen:
      return stateOf(side, fmt::format(" for {:.1f} s", side.silent_for));
    case State::kRefused:
      return fmt::format("{} refused: {}", side.name, side.fault);
    case State::kEnded:
      return side.name + " ended";
    case State::kReceiving:
      break;
  }
  if (isBehind(side))
    return fmt::format("tracking is {:.1f} s behind: it is slower than the incoming data", side.backlog);
  if (!side.warning.empty()) return fmt::format("{}: {}", side.name, side.warning);
  const std::string encoders = encodersText(side), counts = countsText(side);
  if (!encoders.empty() || counts.empty()) return encoders;
  return fmt::format("{}: {}", side.name, counts);
}

std::string encodersText(const SideStatus& side) {
  const std::string why = whyNotUsed(side.encoders);
  return why.empty() ? why : side.name + ": " + why;
}

std::string outdatedText(const std::vector<SideStatus>& sides, const std::string& camera) {
  for (const SideStatus& side : sides) {
    const bool of_it = side.name == "cameras" && (side.part.empty() || side.part == camera);
    if (!of_it || side.received == 0 || side.state == State::kReceiving || side.state == State::kEnded)
      continue;
    const std::string how_long = side.silent_for > 0.0 ? fmt::format(" for {:.0f} s", side.silent_for) : "";
    return std::string(base::nameOf(side.state)) + how_long;
  }
  return {};
}

std::string textOf(const SideStatus& side) {
  std::string text =
      fmt::format("{} {} from {}: {}, {} missing, {} repeated, {} dropped; {}", side.name,
                  base::nameOf(side.state), side.from, counted(side.received, side.counted), side.missing,
                  side.repeated, side.dropped, counted(side.connections, "connection"));
  if (const auto& clock = side.clock)
    text += fmt::format("; {}; clock offset {:.6f} ± {:.6f} s, {}, mean delay {:.2f} ms",
                        counted(clock->steps, "clock step"), clock->offset, clock->offset_sigma,
                        driftText(*clock), 1e3 * clock->mean_delay);
  if (side.latency)
    text += fmt::format("; arrival to estimate {:.2f} ms, 99 % within {:.2f} ms", 1e3 * side.latency->median,
                        1e3 * side.latency->p99);
  if (side.times) text += fmt::format("; times by {}", base::nameOf(*side.times));
  if (side.unpaired + side.frozen > 0)
    text += fmt::format("; {} unpaired, {} frozen", side.unpaired, side.frozen);
  if (side.gaps > 0)
    text += fmt::format("; {} in the times, the last of {:.1f} s", counted(side.gaps, "gap"), side.last_gap);
  if (side.incomplete > 0) text += fmt::format("; {} incomplete", counted(side.incomplete, side.counted));
  if (side.undated > 0)
    text += fmt::format("; {} excluded before their time was known", counted(side.undated, "pair"));
  if (side.encoders.unmatched > 0)
    text += fmt::format("; joint encoders of {} unmatched", counted(side.encoders.unmatched, "row"));
  if (side.encoders.late > 0)
    text += fmt::format("; {} of joint encoders too late", counted(side.encoders.late, "message"));
  if (const std::string why = whyNotUsed(side.encoders); !why.empty()) text += "; " + why;
  if (side.refused > 0) text += fmt::format("; {} refused", side.refused);
  if (!side.fault.empty()) text += "; last fault: " + side.fault;
  if (!side.warning.empty()) text += "; " + side.warning;
  if (!side.reason.empty()) text += "; no data: " + side.reason;
  return text;
}

}  // namespace capstan::tracking
