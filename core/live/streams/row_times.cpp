#include "core/live/streams/row_times.h"

#include <algorithm>

namespace capstan::live {

std::optional<double> RowTimes::of(double stamp, double arrival) {
  double time = stamp + offset_;
  if (!started_) {
    started_ = true;
    offset_ = -stamp, time = 0.0;
  } else {
    constexpr double kLeastPause = 1e-3;  // [s]
    const double passed = std::max(arrival - arrival_, kLeastPause), ahead = stamp - stamp_;
    if (ahead < -kBack || ahead > arrival - arrival_ + kAhead || (reconnected_ && ahead <= 0.0)) {
      ++steps_;
      last_step_ = ahead - passed;
      time = time_ + passed;  // not stamp + offset: the stamp may be too large to hold the difference
      offset_ = time - stamp;
    } else if (ahead <= 0.0 || time <= time_) {
      ++repeated_;
      return {};
    }
  }
  reconnected_ = false;
  stamp_ = stamp, arrival_ = arrival, time_ = time;
  return time;
}

}  // namespace capstan::live
