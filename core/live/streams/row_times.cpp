#include "core/live/streams/row_times.h"

#include <algorithm>

namespace capstan::live {

bool RowTimes::runsAhead(double time, double arrival) const {
  const double passed = arrival - begun_;
  const double waited = passed < kSettling ? kFirstWait - lead_ : 0.0;
  return time - passed > lead_ + waited + kAhead;
}

/// lead_ rises to that of rows in time, at once while it settles, and then no faster than clocks differ.
void RowTimes::follow(double time, double arrival) {
  const double lead = time - (arrival - begun_);
  if (lead <= lead_) return;
  const bool settling = arrival - begun_ < kSettling;
  lead_ = settling ? lead : std::min(lead, lead_ + kFast * (arrival - arrival_));
}

std::optional<double> RowTimes::of(double stamp, double arrival) {
  double time = stamp + offset_;
  if (!started_) {
    started_ = true;
    offset_ = -stamp, time = 0.0;
    begun_ = arrival_ = arrival;
  } else {
    constexpr double kLeastPause = 1e-3, kLeastStep = 1e-6;  // [s]
    const double passed = std::max(arrival - arrival_, kLeastPause), ahead = stamp - stamp_;
    const bool stepped = ahead < -kBack || ahead > arrival - arrival_ + kAhead || runsAhead(time, arrival);
    if (stepped || (reconnected_ && ahead <= 0.0)) {
      ++steps_;
      last_step_ = ahead - passed;
      // Not stamp + offset: the stamp may be too large to hold the difference. Where the session's clock is
      // ahead, it waits for this computer's.
      const double in_time = arrival - begun_ + lead_;
      time = time_of_step_ = std::max(time_ + kLeastStep, std::min(time_ + passed, in_time));
      offset_ = time - stamp;
    } else if (ahead <= 0.0 || time <= time_) {
      ++repeated_;
      return {};
    }
  }
  follow(time, arrival);
  reconnected_ = false;
  stamp_ = stamp, arrival_ = arrival, time_ = time;
  return time;
}

}  // namespace capstan::live
