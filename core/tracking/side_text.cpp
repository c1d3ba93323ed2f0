#include "core/tracking/side_text.h"

#include <fmt/format.h>

namespace capstan::tracking {
namespace {

using State = SideStatus::State;

std::string counted(std::uint64_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

}  // namespace

bool needsAttention(const SideStatus& side) {
  return side.state == State::kSilent || side.state == State::kRefused || side.state == State::kEnded;
}

std::string shortTextOf(const SideStatus& side) {
  switch (side.state) {
    case State::kWaiting:
      return fmt::format("{}: waiting at {}", side.name, side.from);
    case State::kSilent:
      return fmt::format("{} silent for {:.1f} s", side.name, side.silent_for);
    case State::kRefused:
      return fmt::format("{} refused: {}", side.name, side.fault);
    case State::kEnded:
      return side.name + " ended";
    case State::kReceiving:
      break;
  }
  std::string text;
  if (side.dropped > 0) text = fmt::format("{}: {} dropped", side.name, side.dropped);
  return text;
}

std::string textOf(const SideStatus& side) {
  std::string text = fmt::format(
      "{} {} from {}: {}, {} repeated, {} dropped; {}, {}; clock offset {:.6f} ± {:.6f} s, drift {:.2f} ± "
      "{:.2f} ppm, mean delay {:.2f} ms",
      side.name, base::nameOf(side.state), side.from, counted(side.received, "row"), side.repeated,
      side.dropped, counted(side.connections, "connection"), counted(side.clock_steps, "clock step"),
      side.offset, side.offset_sigma, 1e6 * side.drift, 1e6 * side.drift_sigma, 1e3 * side.mean_delay);
  if (side.unpaired + side.frozen > 0)
    text += fmt::format("; {} unpaired, {} frozen", side.unpaired, side.frozen);
  if (!side.fault.empty()) text += "; refused: " + side.fault;
  return text;
}

}  // namespace capstan::tracking
