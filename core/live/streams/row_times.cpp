#include "core/live/streams/row_times.h"

#include <algorithm>

namespace capstan::live {

/// By how much the time is beyond the largest lead of the session's clock.
double RowTimes::aheadBy(double time, double arrival) const {
  const double passed = arrival - begun_;
  const double waited = passed < kSettling ? kFirstWait - lead_ : 0.0;
  return time - passed - (lead_ + waited + kAhead);
}

double RowTimes::tooEarly(double stamp, double arrival) const {
  const double ahead = stamp - stamp_;
  if (!started_ || ahead < 0.0 || ahead > kAhead) return 0.0;
  return std::max(0.0, aheadBy(stamp + offset_, arrival));
}

/// lead_ rises at once to that of the rows while it settles; then it follows theirs, no faster than clocks
/// differ.
void RowTimes::follow(double time, double arrival) {
  const double lead = time - (arrival - begun_), most = kFast * (arrival - arrival_);
  if (arrival - begun_ < kSettling)
    lead_ = std::max(lead_, lead);
  else
    lead_ += std::clamp(lead - lead_, -most, most);
}

/// Whether a row follows one that was far behind: the clock has stepped.
bool RowTimes::goesOn(double stamp) const { return back_ && stamp > *back_; }

std::optional<double> RowTimes::of(double stamp, double arrival) {
  double time = stamp + offset_;
  if (!started_) {
    started_ = true;
    offset_ = -stamp, time = 0.0;
    begun_ = arrival_ = arrival;
  } else {
    constexpr double kLeastPause = 1e-3, kLeastStep = 1e-6;  // [s]
    const double passed = std::max(arrival - arrival_, kLeastPause), ahead = stamp - stamp_;
    if (ahead < -kBack && !reconnected_ && !goesOn(stamp)) {
      back_ = stamp;
      ++repeated_;
      return {};
    }
    const bool stepped = ahead < -kBack || aheadBy(time, arrival) > 0.0;
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
  back_.reset();
  reconnected_ = false;
  stamp_ = stamp, arrival_ = arrival, time_ = time;
  return time;
}

}  // namespace capstan::live
