#include "widgets/figures/range_statistics.h"

#include <cmath>
#include <limits>

namespace capstan::widgets {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class Sums {
 public:
  void add(float number) {
    const auto value = static_cast<double>(number);
    if (!std::isfinite(value)) return;
    // Welford's recurrence: no loss of digits where the mean is large.
    ++count_;
    const double step = value - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (value - mean_);
  }
  RangeStatistics result() const {
    if (count_ == 0) return {0, kNone, kNone, kNone};
    const auto count = static_cast<double>(count_);
    return {count_, mean_, count_ > 1 ? std::sqrt(squares_ / (count - 1.0)) : 0.0,
            std::sqrt(mean_ * mean_ + squares_ / count)};
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// Calls `visit` with the items of a ring in [begin, end].
template <class Items, class Visit>
void forEachWithin(const Items& items, double begin, double end, Visit&& visit) {
  for (std::size_t i = items.partitionPoint([&](const auto& item) { return item.t < begin; });
       i < items.size() && items[i].t <= end; ++i)
    visit(items[i]);
}

float valueOf(const JointValues& values, Quantity quantity) {
  return quantity == Quantity::kTrue  ? values.truth
         : quantity == Quantity::kUkf ? values.ukf
                                      : values.kinematic;
}

}  // namespace

RangeStatistics statisticsOf(const JointHistory& history, int joint, Quantity quantity, double begin,
                             double end) {
  const auto index = static_cast<std::size_t>(joint);
  Sums sums;
  if (quantity == Quantity::kCamera)
    forEachWithin(history.camera(), begin, end, [&](const auto& point) { sums.add(point.value[index]); });
  else
    forEachWithin(history.rows(), begin, end,
                  [&](const auto& row) { sums.add(valueOf(row.joint[index], quantity)); });
  return sums.result();
}

}  // namespace capstan::widgets
