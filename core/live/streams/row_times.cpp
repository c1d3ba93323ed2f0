#include "core/live/streams/row_times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::live {

std::optional<double> RowTimes::of(double stamp, double arrival) {
  if (!started_) {
    started_ = true;
    offset_ = -stamp;
  } else {
    constexpr double kLeastPause = 1e-3;  // [s]
    const double passed = arrival - arrival_, ahead = stamp - stamp_;
    if (ahead < -kBack || ahead > passed + kAhead) {
      ++steps_;
      last_step_ = ahead - std::max(passed, kLeastPause);
      offset_ -= last_step_;
    } else if (ahead <= 0.0 || stamp + offset_ <= time_) {  // the sum may round to the time before
      ++repeated_;
      return {};
    }
  }
  stamp_ = stamp, arrival_ = arrival;
  time_ = std::max(stamp + offset_, std::nextafter(time_, std::numeric_limits<double>::infinity()));
  return time_;
}

}  // namespace capstan::live
