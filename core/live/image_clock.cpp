#include "core/live/image_clock.h"

#include <cmath>

#include "core/ros1/stamp.h"

namespace capstan::live {

double ImageClock::add(int stream, std::int64_t stamp, double arrival) {
  Stream& own = streams_.at(static_cast<std::size_t>(stream));
  if (stamp == 0) return byStamp() ? common_.toDevice(arrival) : arrival;
  if (origin_ == 0) origin_ = stamp;
  own.newest = ros1::secondsOf(stamp - origin_);
  own.stamped = true;
  common_.add(own.newest, arrival, static_cast<std::size_t>(stream));
  own.map.add(own.newest, arrival);
  decide(arrival);
  if (separate_) return own.map.jumped() ? arrival : own.map.toSession(own.newest);
  return common_.jumped(static_cast<std::size_t>(stream)) ? common_.toDevice(arrival) : own.newest;
}

/// Until the first decision the maps count at once: streams of two clocks would give wrong pairs meanwhile.
void ImageClock::decide(double arrival) {
  if (!may_differ_ || !streams_[0].stamped || !streams_[1].stamped) return;
  const double t = streams_[0].newest;
  const bool apart = std::abs(streams_[0].map.toSession(t) - streams_[1].map.toSession(t)) > kApart;
  if (!opposite_since_) opposite_since_ = arrival;
  if (decided_ && apart == separate_) return void(opposite_since_ = arrival);
  const bool lasting = arrival - *opposite_since_ >= kDecide;
  if (decided_ && !lasting) return;
  if (separate_ && !apart) {  // it has been of no clock
    common_.forget();
    for (std::size_t k : {0, 1})
      common_.add(streams_[k].newest, streams_[k].map.toSession(streams_[k].newest), k);
  }
  separate_ = apart;
  if (lasting) decided_ = true, opposite_since_ = arrival;
}

double ImageClock::computerTime(double pairing_time) const {
  return byStamp() ? common_.toSession(pairing_time) : pairing_time;
}

std::optional<std::int64_t> ImageClock::stampOf(double pairing_time) const {
  if (!byStamp()) return {};
  return origin_ + ros1::nanosecondsOf(pairing_time);
}

}  // namespace capstan::live
