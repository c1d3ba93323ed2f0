#include "core/live/streams/clock_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace capstan::live {

bool ClockMap::Deviation::lasts(const Pair& pair, double time) {
  const double arrival = pair.stamp + pair.delay;
  if (!on) since = arrival, lowest = pair;
  if (pair.delay < lowest.delay) lowest = pair;
  on = true;
  return arrival - since >= time;
}

void ClockMap::forget() {
  started_ = false;
  streams_ = {};
}

void ClockMap::restart(const Pair& pair) {
  bins_.assign(1, pair);
  bin_begin_ = origin_ = newest_ = pair.stamp;
  begun_ = pair.stamp + pair.delay;
  level_ = pair.delay, slope_ = 0.0;
  for (Stream& stream : streams_) stream.jumped = false;
  stepped_.on = late_.on = false;
  started_ = true;
  pairs_ = 1;
}

/// Back, or ahead of the arrivals and below the line. A line that has just begun may be too high, and pairs
/// that were lost in a backlog look like a jump ahead.
bool ClockMap::jumps(const Stream& stream, double stamp, double arrival) const {
  if (!stream.started) return false;
  const double passed = stamp - stream.stamp;
  if (passed < 0.0) return true;
  return passed - (arrival - stream.arrival) > kStep && arrival - stamp - line(stamp) < -kStep &&
         arrival - begun_ > kSettling;
}

bool ClockMap::add(double stamp, double arrival, std::size_t stream) {
  const Pair pair{stamp, arrival - stamp};
  Stream& own = streams_.at(stream);
  if (!started_) restart(pair);
  own.jumped |= jumps(own, stamp, arrival);
  own.started = true, own.stamp = stamp, own.arrival = arrival;
  const double above = pair.delay - line(stamp);
  if (own.jumped && std::abs(above) > kStep) {
    if (!stepped_.lasts(pair, kStepTime)) return false;
    ++steps_;
    restart(Pair(stepped_.lowest));
    return true;
  }
  own.jumped = false;
  if (std::ranges::none_of(streams_, &Stream::jumped)) stepped_.on = false;
  if (above < -kStep) {
    restart(pair);
    return false;
  }
  if (above <= kTooLate)
    late_.on = false;
  else if (late_.lasts(pair, kTooLateFor))
    restart(Pair(late_.lowest));
  else
    return false;
  take(pair, pair.delay - line(stamp));
  return false;
}

void ClockMap::take(const Pair& pair, double above) {
  const auto& [stamp, delay, count] = pair;
  newest_ = std::max(newest_, stamp);
  ++pairs_;
  constexpr double kForget = 1e-3;
  mean_delay_ += std::max(kForget, 1.0 / pairs_) * (std::max(above, 0.0) - mean_delay_);
  if (stamp - bin_begin_ >= kBin) {
    bins_.push_back(pair);
    bin_begin_ = stamp;
    while (bins_.front().stamp < stamp - kWindow) bins_.pop_front();
    fit();
    return;
  }
  Pair& bin = bins_.back();
  bin.count += count;
  if (delay - slope_ * stamp < bin.delay - slope_ * bin.stamp) {
    bin.stamp = stamp, bin.delay = delay;
    if (above < 0.0) fit();
  }
}

/// The edge of the lower convex hull at the mean stamp: of all lines below the pairs it has the smallest sum
/// of distances from them. With the drift at its bound, the line touches the pairs from below.
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
  if (std::abs(slope_) <= kMostDrift) return;
  slope_ = std::copysign(kMostDrift, slope_);
  for (const Pair& pair : bins_) level_ = std::min(level_, pair.delay - slope_ * (pair.stamp - origin_));
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
