#pragma once

#include <optional>
#include <string>

#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Notices when camera samples are not used for longer than a blink, why, and when they are used again: for a
/// log, and for the events of a recording.
class GateWatch {
 public:
  static constexpr double kBlink = 0.5;  ///< shorter times without a used camera sample say nothing [s]

  /// A sentence, as "camera not used: both lost" or "camera used again after 2.0 s", or nothing. Takes every
  /// snapshot in order.
  std::optional<std::string> observe(const Snapshot& snapshot);
  /// observe() says again that camera samples are not used, if that is so: for a recording that begins.
  void restate() { reason_.reset(); }

 private:
  std::optional<double> shut_since_;        ///< time of the first sample that was not used [s]
  std::optional<std::string_view> reason_;  ///< that was said last; nothing: the gate is open
};

}  // namespace capstan::tracking
