#include "core/tracking/gate_watch.h"

#include <fmt/format.h>

#include <utility>

namespace capstan::tracking {

std::optional<std::string> GateWatch::observe(const Snapshot& snapshot) {
  if (!snapshot.camera_updated) return {};
  if (snapshot.gate != Gate::kOpen) {
    if (!shut_since_) shut_since_ = snapshot.t;
    const std::string_view reason = gateWords(snapshot);
    if (snapshot.t - *shut_since_ < kBlink || reason_ == reason) return {};
    reason_ = reason;
    return fmt::format("{}{}", snapshot.ray_used ? "" : "camera not used: ", reason);
  }
  const std::optional<double> since = std::exchange(shut_since_, std::nullopt);
  if (!std::exchange(reason_, std::nullopt)) return {};
  return fmt::format("camera used again after {:.1f} s", snapshot.t - *since);
}

}  // namespace capstan::tracking
