#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace capstan::tracking {

/// Ring buffer of the newest samples of a vector signal, with increasing times. Interpolates linearly, and
/// extrapolates linearly for one step.
class TimeSeries {
 public:
  explicit TimeSeries(std::size_t capacity) : points_(capacity) {}

  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }
  /// Adds a sample; ignores it unless it is newer than the newest.
  void push(double t, const Eigen::Vector3d& value) {
    if (count_ > 0 && !(t > back(0).t)) return;
    points_[count_ % points_.size()] = {t, value};
    ++count_;
  }
  double newestTime() const { return back(0).t; }

  /// Value at t [s]. The extrapolated value holds until `hold` [s] after the newest sample. Nothing before
  /// the oldest sample or after that time.
  std::optional<Eigen::Vector3d> at(double t, double hold) const {
    if (count_ == 0 || !(t <= back(0).t + hold)) return std::nullopt;
    if (t >= back(0).t) return beyond(t);
    const std::size_t kept = count_ < points_.size() ? count_ : points_.size();
    std::size_t newer = 0, older = kept - 1;  // drifts: back(newer).t > t, back(older).t <= t
    if (t < back(older).t) return std::nullopt;
    while (older - newer > 1) {
      const std::size_t middle = (newer + older) / 2;
      (back(middle).t <= t ? older : newer) = middle;
    }
    const Point& a = back(older);
    const Point& b = back(newer);
    return a.value + (t - a.t) / (b.t - a.t) * (b.value - a.value);
  }

 private:
  struct Point {
    double t;
    Eigen::Vector3d value;
  };
  Eigen::Vector3d beyond(double t) const {
    if (count_ < 2) return back(0).value;
    const double step = back(0).t - back(1).t;
    return back(0).value + std::min((t - back(0).t) / step, 1.0) * (back(0).value - back(1).value);
  }
  const Point& back(std::size_t age) const { return points_[(count_ - 1 - age) % points_.size()]; }

  std::vector<Point> points_;
  std::size_t count_ = 0;
};

}  // namespace capstan::tracking
