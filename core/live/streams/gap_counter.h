#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace capstan::live {

/// Counts the samples that are missing between those that came, from their own times: a sender with a steady
/// period leaves a gap of two periods where one is missing. A sender that was held up stamps the rows that it
/// then sends at once with almost the same time: right after a gap, each interval below half a period is a
/// sample that was late and is not missing. The period is the median of the first kLearned intervals, and of
/// each kLearned after them.
class GapCounter {
 public:
  static constexpr std::size_t kLearned = 32;
  static constexpr double kSilence = 0.35;  ///< a longer gap is a silence, not missing samples [s]
  static constexpr double kLeastPeriod =
      1e-5;  ///< no robot sends faster: smaller intervals are no period [s]

  void add(double t) {
    const double interval = t - last_;
    last_ = t;
    if (count_++ == 0 || interval <= 0.0 || interval > kSilence) return;
    if (period_ > 0.0) judge(std::round(interval / period_));
    intervals_[learned_++] = interval;
    if (learned_ < kLearned) return;
    const auto middle = intervals_.begin() + kLearned / 2;
    std::nth_element(intervals_.begin(), middle, intervals_.end());
    period_ = std::max(*middle, kLeastPeriod);
    learned_ = 0;
  }
  /// Samples missing so far; those of the newest gap count with the sample after it.
  std::uint64_t missing() const { return missing_; }

 private:
  void judge(double periods) {
    if (periods < 1.0) {
      if (gap_ > 0) --gap_;
      return;
    }
    missing_ += std::exchange(gap_, static_cast<std::uint64_t>(periods) - 1);
  }

  std::array<double, kLearned> intervals_{};
  std::size_t learned_ = 0;
  double last_ = 0.0, period_ = 0.0;
  std::uint64_t count_ = 0, missing_ = 0;
  std::uint64_t gap_ = 0;  ///< samples of the newest gap that have not come late
};

}  // namespace capstan::live
