#include "core/live/streams/clock_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::live {

ClockAgreement::Verdict ClockAgreement::add(double lateness, int steps, double t) {
  if (std::exchange(steps_, steps) != steps) pairs_ = 0, latest_ = kLatest;
  if (lateness > kEarliest && lateness < kLatest) latest_ = kLatest;
  if (pairs_ == kPairs && follows(lateness, t)) return Verdict::kAgree;
  followed_ = lateness, followed_t_ = t;
  if (lateness > kEarliest && lateness < latest_) {
    pairs_ = std::min(pairs_ + 1, kPairs);
    decided_ = true;
    return Verdict::kAgree;
  }
  pairs_ = 0;
  if (!apart_since_) apart_since_ = t;
  decided_ = decided_ || std::abs(lateness) > kFar || t - *apart_since_ >= kDecide;
  if (!decided_) return Verdict::kUndecided;
  latest_ = kLatest;
  return Verdict::kDiffer;
}

/// Whether clocks that have agreed for kPairs still do.
bool ClockAgreement::follows(double lateness, double t) {
  const double most = kDrift * std::max(0.0, t - followed_t_);
  followed_ += std::clamp(lateness - followed_, -most, most);
  followed_t_ = t;
  if (followed_ > kEarliest - kMargin && followed_ < latest_ + kMargin) return true;
  pairs_ = 0;
  return false;
}

}  // namespace capstan::live
