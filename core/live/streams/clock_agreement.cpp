#include "core/live/streams/clock_agreement.h"

#include <algorithm>
#include <utility>

namespace capstan::live {

bool ClockAgreement::add(double lateness, int steps, double t) {
  if (std::exchange(steps_, steps) != steps) pairs_ = 0;
  if (pairs_ == kPairs) {
    const double most = kDrift * std::max(0.0, t - followed_t_);
    followed_ += std::clamp(lateness - followed_, -most, most);
    followed_t_ = t;
    if (followed_ > kEarliest - kMargin && followed_ < kLatest + kMargin) return true;
    pairs_ = 0;
  }
  const bool agree = lateness > kEarliest && lateness < kLatest;
  pairs_ = agree ? pairs_ + 1 : 0;
  followed_ = lateness, followed_t_ = t;
  return agree;
}

}  // namespace capstan::live
