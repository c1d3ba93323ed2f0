#include "core/live/streams/clock_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace capstan::live {

void ClockMap::restart(double stamp, double delay) {
  bins_.assign(1, {stamp, delay});
  bin_begin_ = origin_ = newest_ = stamp;
  level_ = delay, slope_ = 0.0;
  deviating_ = false, started_ = true;
  pairs_ = 1;
}

bool ClockMap::add(double stamp, double arrival) {
  const double delay = arrival - stamp;
  if (!started_) {
    restart(stamp, delay);
    return false;
  }
  const double above = delay - line(stamp);
  const double tolerance = kStep + 5.0 * mean_delay_;
  if (above < -kStep || above > tolerance) {
    if (!deviating_) deviating_since_ = arrival, nearest_ = {stamp, delay};
    if (delay < nearest_.delay) nearest_ = {stamp, delay};
    deviating_ = true;
    if (arrival - deviating_since_ < kStepTime) return false;
    ++steps_;
    restart(nearest_.stamp, nearest_.delay);
    return true;
  }
  deviating_ = false;
  newest_ = std::max(newest_, stamp);
  ++pairs_;
  constexpr double kForget = 1e-3;
  mean_delay_ += std::max(kForget, 1.0 / pairs_) * (std::max(above, 0.0) - mean_delay_);
  const bool lower = above < 0.0;
  if (stamp - bin_begin_ >= kBin) {
    bins_.push_back({stamp, delay});
    bin_begin_ = stamp;
    while (bins_.front().stamp < stamp - kWindow) bins_.pop_front();
    fit();
    return false;
  }
  Pair& bin = bins_.back();
  ++bin.count;
  if (delay - slope_ * stamp < bin.delay - slope_ * bin.stamp) {
    bin.stamp = stamp, bin.delay = delay;
    if (lower) fit();
  }
  return false;
}

/// The edge of the lower convex hull at the mean stamp: of all lines below the pairs it has the smallest sum
/// of distances from them.
void ClockMap::fit() {
  double mean = 0.0;
  for (const Pair& pair : bins_) mean += pair.stamp / static_cast<double>(bins_.size());
  std::vector<Pair> hull;
  for (const Pair& pair : bins_) {
    const auto turnsUp = [&] {
      const Pair &a = hull[hull.size() - 2], &b = hull.back();
      return (b.stamp - a.stamp) * (pair.delay - a.delay) - (b.delay - a.delay) * (pair.stamp - a.stamp) >
             0.0;
    };
    while (hull.size() >= 2 && !turnsUp()) hull.pop_back();
    hull.push_back(pair);
  }
  constexpr double kLeastSpan = 2.0;  // [s]: over less a drift is not observable
  const bool short_span = bins_.back().stamp - bins_.front().stamp < kLeastSpan;
  if (hull.size() < 2 || short_span) {
    const Pair lowest = *std::ranges::min_element(bins_, {}, &Pair::delay);
    origin_ = lowest.stamp, level_ = lowest.delay, slope_ = 0.0;
    return;
  }
  std::size_t k = 1;
  while (k + 1 < hull.size() && hull[k].stamp < mean) ++k;
  const Pair &a = hull[k - 1], &b = hull[k];
  origin_ = a.stamp, level_ = a.delay;
  slope_ = (b.delay - a.delay) / (b.stamp - a.stamp);
}

double ClockMap::toSession(double stamp) const { return stamp + line(stamp); }
double ClockMap::toDevice(double session) const {
  return origin_ + (session - origin_ - level_) / (1.0 + slope_);
}
double ClockMap::offset() const { return line(newest_); }

/// The smallest of n / 2 exponential delays of mean m exceeds zero by 2 m / n in the mean, and has this
/// standard deviation. The line lies on the smallest of each half of the pairs, about half the span T apart;
/// the newest stamp is a quarter of the span beyond the second one, whose error counts 3/2 there, and that of
/// the first one −1/2.
double ClockMap::errorOfEnd() const {
  double pairs = 0.0;
  for (const Pair& pair : bins_) pairs += pair.count;
  return std::numbers::sqrt2 * mean_delay_ / std::max(1.0, pairs / 2.0);
}
double ClockMap::offsetUncertainty() const { return std::hypot(1.5, 0.5) * errorOfEnd(); }
double ClockMap::driftUncertainty() const { return std::numbers::sqrt2 * errorOfEnd() / (span() / 2.0); }
double ClockMap::span() const { return std::max(newest_ - bins_.front().stamp, kBin); }

}  // namespace capstan::live
