#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace capstan::stats {

/// Counts the samples that are missing between those that came, from their own times: a sender with a steady
/// period leaves a gap of two periods where one is missing. A sender that was held up stamps the rows that it
/// then sends at once with almost the same time: each interval below half a period makes up for a sample of
/// the gap, until kSettled intervals in turn have one period.
///
/// The period is the median of the medians of the last kBlocks blocks of kLearned intervals. Where most
/// intervals are those of a sender that makes up for a gap, it is their mean.
class GapCounter {
 public:
  static constexpr std::size_t kLearned = 32, kBlocks = 32;
  static constexpr int kSettled = 8;
  static constexpr double kSilence = 0.35;  ///< a longer gap is a silence, not missing samples [s]
  static constexpr double kLeastPeriod =
      1e-5;  ///< no robot sends faster: smaller intervals are no period [s]

  void add(double t) {
    const double interval = t - last_;
    last_ = t;
    if (count_++ == 0 || interval <= 0.0) return;
    span_ += std::min(interval, kSilence);
    if (period_ == 0.0 || interval > kSilence) credit_ = 0;
    if (interval > kSilence) {
      ++silences_, last_silence_ = interval;
      return settle();
    }
    if (period_ > 0.0) judge(std::round(interval / period_));
    intervals_[learned_++] = interval;
    if (learned_ == kLearned) learn();
  }
  /// The next gaps have `lost` samples that came and were lost here: they are counted elsewhere.
  void credit(std::uint64_t lost) { credit_ += lost; }
  /// Samples missing so far; those of the newest gap may still come late.
  std::uint64_t missing() const { return missing_ + gap_; }
  std::uint64_t silences() const { return silences_; }  ///< so far
  double lastSilence() const { return last_silence_; }  ///< length of the newest one [s]

 private:
  void settle() { missing_ += gap_, gap_ = 0, regular_ = 0; }

  void judge(double periods) {
    if (periods == 1.0) {
      if (++regular_ == kSettled) settle();
      return;
    }
    regular_ = 0;
    if (periods > 1.0) {
      const auto absent = static_cast<std::uint64_t>(periods) - 1, known = std::min(absent, credit_);
      credit_ -= known;
      gap_ += absent - known;
    } else if (gap_ > 0)
      --gap_;
  }

  void learn() {
    constexpr double kLeastShare = 0.4;  // of the mean; half of the rows missing at random leave 0.5
    blocks_[block_ % kBlocks] = {medianOf(intervals_, kLearned), span_};
    const std::size_t count = std::min(++block_, kBlocks);
    std::array<double, kBlocks> medians;
    double span = 0.0;
    for (std::size_t k = 0; k < count; ++k) medians[k] = blocks_[k].median, span += blocks_[k].span;
    const double median = medianOf(medians, count), mean = span / static_cast<double>(count * kLearned);
    period_ = std::max(median < kLeastShare * mean ? mean : median, kLeastPeriod);
    learned_ = 0, span_ = 0.0;
  }

  template <std::size_t N>
  static double medianOf(std::array<double, N>& values, std::size_t count) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  struct Block {
    double median = 0.0, span = 0.0;  ///< of its intervals [s]; silences count as kSilence
  };
  std::array<double, kLearned> intervals_{};
  std::array<Block, kBlocks> blocks_{};
  std::size_t learned_ = 0, block_ = 0;
  double last_ = 0.0, period_ = 0.0, span_ = 0.0;
  double last_silence_ = 0.0;
  std::uint64_t count_ = 0, missing_ = 0, silences_ = 0;
  std::uint64_t gap_ = 0;     ///< samples of the newest gaps that have not come late
  std::uint64_t credit_ = 0;  ///< of credit(), not found in a gap yet
  int regular_ = 0;           ///< intervals of one period in turn
};

}  // namespace capstan::stats
