#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/room.h"

namespace capstan::analysis {

/// Points of a stream in fixed memory. When `capacity` points are stored, every second one is dropped and the
/// stride doubles: then every 2nd, 4th, 8th … point of the stream is stored.
template <class Point>
class KeptPoints {
 public:
  /// Takes memory for `reserved` points, so that add() takes none up to this number.
  KeptPoints(std::size_t capacity, std::size_t reserved)
      : capacity_(capacity), points_(base::roomFor<Point>(reserved)) {}

  void add(const Point& point) {
    if (offered_++ % stride_ != 0) return;
    if (points_.size() == capacity_) {
      dropEveryOther();
      if ((offered_ - 1) % stride_ != 0) return;
    }
    points_.push_back(point);
  }
  void clear() {
    points_.clear();
    offered_ = 0;
    stride_ = 1;
  }
  const std::vector<Point>& points() const { return points_; }

 private:
  void dropEveryOther() {
    for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }

  std::size_t capacity_;
  std::vector<Point> points_;
  std::uint64_t offered_ = 0, stride_ = 1;
};

}  // namespace capstan::analysis
