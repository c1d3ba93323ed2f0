#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace capstan::stats {

/// Counts the samples that are missing between those that came, from their own times t_k. A sender is held up
/// now and then, and stamps samples late, but never early: sample k was due at
///
///     d_k = min over i of (t_i + (k − i) · period),  i = k − kWindow + 1 … k,
///
/// if one of these samples was in time. Where d_k rises by a period more than it should, a sample is missing;
/// where it then falls by one, a sample came late that had been counted as missing. The newest kWindow
/// samples may hide gaps that are not counted yet. Delays that are as long as the period and change with
/// every sample hide some for good.
///
/// The period is the median of the usual intervals of the last kBlocks blocks of kLearned. Where most
/// intervals are those of a sender that makes up for a gap, it is their mean. kOthers blocks in
/// succession with another usual interval are those of a sender with another period.
class GapCounter {
 public:
  static constexpr std::size_t kLearned = 32, kBlocks = 32;
  static constexpr std::size_t kWindow = 16, kOthers = 4;
  static constexpr double kSilence = 0.35;  ///< a longer gap is a silence, not missing samples [s]
  static constexpr double kLeastPeriod =
      1e-5;  ///< no robot sends faster: smaller intervals are no period [s]

  void add(double t) {
    const double interval = t - last_;
    last_ = t;
    if (count_++ == 0 || interval == 0.0) return;
    if (interval < 0.0) return endRun();  // another clock
    span_ += std::min(interval, kSilence);
    if (interval > kSilence) {
      ++silences_, last_silence_ = interval;
      return endRun();
    }
    if (period_ > 0.0)
      judge(t);
    else
      credit_ = 0;
    intervals_[learned_++] = interval;
    if (learned_ == kLearned) learn();
  }
  /// The next gaps have `lost` samples that came and were lost here: they are counted elsewhere.
  void credit(std::uint64_t lost) { credit_ += lost; }
  std::uint64_t missing() const { return missing_; }    ///< samples so far
  std::uint64_t silences() const { return silences_; }  ///< so far
  double lastSilence() const { return last_silence_; }  ///< length of the newest one [s]

 private:
  static constexpr std::size_t kLast = 4;  ///< samples that tell what is missing where a silence follows

  /// When the newest sample was due, by the newest `samples` ones [s].
  double due(std::size_t samples) const {
    double due = times_[(window_ - 1) % kWindow];
    for (std::size_t back = 1; back < std::min(window_, samples); ++back)
      due = std::min(due, times_[(window_ - 1 - back) % kWindow] + static_cast<double>(back) * period_);
    return due;
  }

  /// What follows belongs to other times: gaps that the newest samples still hide are counted.
  void endRun() {
    if (window_ > 0) note(std::round((due(kLast) - due(kWindow)) / period_));
    credit_ = window_ = open_ = 0;
  }

  void judge(double t) {
    const double before = window_ > 0 ? due(kWindow) : t - period_;
    times_[window_++ % kWindow] = t;
    note(std::round((due(kWindow) - before) / period_) - 1.0);
  }

  /// Counts missing samples; a negative number: late ones, which were counted as missing.
  void note(double periods) {
    const auto samples = static_cast<std::uint64_t>(std::abs(periods));
    if (periods < 0.0) {
      const std::uint64_t late = std::min(open_, samples);
      missing_ -= late, open_ -= late;
      caught_up_ = caught_up_ || late > 0;
    } else if (periods > 0.0) {
      const std::uint64_t known = std::min(samples, credit_);
      credit_ -= known;
      missing_ += samples - known, open_ += samples - known;
    }
    quiet_ = periods == 0.0 ? quiet_ + 1 : 0;
    if (quiet_ >= kLearned) open_ = 0;
  }

  void learn() {
    constexpr double kLeastShare = 0.4;  // of the mean; half of the rows missing at random leave 0.5
    const double usual = usualInterval();
    const bool late = std::exchange(caught_up_, false), catches_up = late && usual < period_;
    const bool other = period_ > 0.0 && std::abs(usual - period_) > 0.4 * period_ && !catches_up;
    others_ = other ? others_ + 1 : 0;
    if (others_ == 0) missing_before_ = missing_;
    if (others_ == kOthers) {
      missing_ = missing_before_;
      block_ = window_ = open_ = others_ = 0;
    }
    blocks_[block_ % kBlocks] = {usual, span_};
    const std::size_t count = std::min(++block_, kBlocks);
    std::array<double, kBlocks> medians;
    double span = 0.0;
    for (std::size_t k = 0; k < count; ++k) medians[k] = blocks_[k].usual, span += blocks_[k].span;
    const double median = medianOf(medians, count), mean = span / static_cast<double>(count * kLearned);
    period_ = std::max(median < kLeastShare * mean ? mean : median, kLeastPeriod);
    learned_ = 0, span_ = 0.0;
  }

  /// Mean of the intervals of the block that are not far from their median, which gaps have made longer.
  double usualInterval() {
    const double median = medianOf(intervals_, kLearned);
    double sum = 0.0, count = 0.0;
    for (const double interval : intervals_)
      if (interval > 0.5 * median && interval < 1.5 * median) sum += interval, ++count;
    return sum / count;
  }

  template <std::size_t N>
  static double medianOf(std::array<double, N>& values, std::size_t count) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  struct Block {
    double usual = 0.0, span = 0.0;  ///< of its intervals [s]; silences count as kSilence
  };
  std::array<double, kLearned> intervals_{};
  std::array<Block, kBlocks> blocks_{};
  std::size_t learned_ = 0, block_ = 0;
  std::array<double, kWindow> times_{};  ///< of the newest samples, the one of number n at n mod kWindow [s]
  std::size_t window_ = 0;               ///< samples since the period is known, or since a silence
  double last_ = 0.0, period_ = 0.0, span_ = 0.0;
  double last_silence_ = 0.0;
  std::uint64_t count_ = 0, missing_ = 0, silences_ = 0;
  std::uint64_t credit_ = 0;          ///< of credit(), not found in a gap yet
  std::uint64_t open_ = 0;            ///< of missing_, may still come late
  std::size_t quiet_ = 0;             ///< samples in succession that changed nothing
  std::size_t others_ = 0;            ///< blocks in succession with another usual interval than the period
  bool caught_up_ = false;            ///< late samples came in this block
  std::uint64_t missing_before_ = 0;  ///< before the blocks of another period
};

}  // namespace capstan::stats
