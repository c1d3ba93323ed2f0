#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace capstan::stats {

/// Counts the samples that are missing between those that came, from their own times: a sender with a steady
/// period leaves a gap of two periods where one is missing. A sender that was held up stamps the rows that it
/// then sends late. What counts is therefore the earliest time at which a sample was due, by the newest
/// kSettled samples of which one was probably in time: what this time has moved by since before the gap, less
/// the samples since then.
///
/// The period is the median of the medians of the last kBlocks blocks of kLearned intervals. Where most
/// intervals are those of a sender that makes up for a gap, it is their mean.
class GapCounter {
 public:
  static constexpr std::size_t kLearned = 32, kBlocks = 32;
  static constexpr std::size_t kSettled = 8;
  /// A gap ends where so many samples in turn leave it as it is, and after so many in any case.
  static constexpr std::size_t kSame = 16, kLongest = 1024;
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
      settle();
      due_.forget();
      return;
    }
    if (period_ > 0.0) judge(t, std::round(interval / period_) == 1.0);
    intervals_[learned_++] = interval;
    if (learned_ == kLearned) learn();
  }
  /// The next gaps have `lost` samples that came and were lost here: they are counted elsewhere.
  void credit(std::uint64_t lost) { credit_ += lost; }
  /// Samples missing so far; those of the newest gap may still come late.
  std::uint64_t missing() const { return missing_ + gap_ - std::min(gap_, credit_); }
  std::uint64_t silences() const { return silences_; }  ///< so far
  double lastSilence() const { return last_silence_; }  ///< length of the newest one [s]

 private:
  /// Earliest time at which the newest sample was due, by itself and the ones before it.
  class Due {
   public:
    void forget() { count_ = 0; }
    void add(double t) { times_[count_++ % kSettled] = t; }
    std::size_t count() const { return count_; }
    /// By the newest `samples` of them, at most kSettled.
    double newest(double period, std::size_t samples) const {
      double due = times_[(count_ - 1) % kSettled];
      for (std::size_t back = 1; back < std::min({samples, count_, kSettled}); ++back)
        due = std::min(due, times_[(count_ - 1 - back) % kSettled] + static_cast<double>(back) * period);
      return due;
    }

   private:
    std::array<double, kSettled> times_{};
    std::size_t count_ = 0;
  };

  void settle() {
    const std::uint64_t known = std::min(gap_, credit_);
    missing_ += gap_ - known, credit_ -= known;
    gap_ = 0, open_ = false;
  }

  void judge(double t, bool regular) {
    if (!open_ && !regular && due_.count() > 0) {
      open_ = true, since_ = same_ = 0;
      before_ = due_.newest(period_, kSettled);
    }
    due_.add(t);
    if (!open_) return;
    ++since_;
    const double periods = std::round((due_.newest(period_, since_) - before_) / period_);
    const auto gap = static_cast<std::uint64_t>(std::max(periods - static_cast<double>(since_), 0.0));
    same_ = std::exchange(gap_, gap) == gap ? same_ + 1 : 0;
    if (since_ == kLongest) due_.forget();  // a gap among its samples would count again
    if (same_ == kSame || since_ == kLongest) settle();
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
  std::uint64_t credit_ = 0;  ///< of credit(), not found in a gap yet
  Due due_;
  bool open_ = false;      ///< a gap, whose late samples may still come
  double before_ = 0.0;    ///< when the last sample before it was due [s]
  std::uint64_t gap_ = 0;  ///< samples missing in it so far
  std::size_t since_ = 0;  ///< samples since it began
  std::size_t same_ = 0;   ///< samples in turn that have left gap_ as it was
};

}  // namespace capstan::stats
