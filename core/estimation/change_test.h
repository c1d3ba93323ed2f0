#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/estimation/information.h"

namespace capstan::estimation {

/// Detects abrupt changes of the coefficients of a regression at unknown times, and keeps the information
/// about the present coefficients.
///
/// Observations are collected in segments. When a segment closes, the hypothesis of no change is compared
/// with those of one change of one kind before one of the newest segments (generalised likelihood ratio;
/// Willsky and Jones, IEEE TAC 21, 1976; here with the evidence in place of the maximum likelihood):
///
///     log p(newest | earlier, change) − log p(newest | earlier, none) > log_odds.
///
/// When this ratio exceeds log_odds, the change is in question: known() returns the information from before
/// the change, until the log odds of one kind exceed those of all others by `lead` and by a quarter of their
/// own value, or until no change is likely any more. After a change of the coefficients by w ~ N(0,
/// diag(variance)), the information from before the change is information about x + w. Units are those of
/// Information. No allocation.
template <int N, int kKinds, int kSegments>
class ChangeTest {
 public:
  using Vector = typename Information<N>::Vector;
  using Kinds = std::array<Vector, kKinds>;
  static constexpr int kNoChange = -1, kInQuestion = -2;

  /// `precision` is that of the prior, `kinds` the variance of w of each kind of change, and `log_odds` the
  /// prior log odds against a change before a given segment.
  ChangeTest(const Vector& precision, const Kinds& kinds, double log_odds, double lead)
      : precision_(precision), kinds_(kinds), log_odds_(log_odds), lead_(lead) {}

  /// Closes a segment with this information. `weight` in (0, 1] is the weight of the observations from here
  /// on, below 1 when their noise is larger than assumed. Returns the detected kind of change, kNoChange or
  /// kInQuestion.
  int close(const Information<N>& information, double weight) {
    if (in_question_) {
      segments_[0].information += information;
    } else {
      if (size_ == kSegments) dropOldest();
      segments_[size_++] = {information, next_weight_};
      next_weight_ = weight;
      const std::size_t change = likeliestChange();
      if (change == kNone) return kNoChange;
      split(change);
    }
    return decide();
  }

  bool inQuestion() const { return in_question_; }
  /// Information about the present coefficients; while a change is in question, that from before the change.
  Information<N> known() const {
    Information<N> known = earlier_;
    if (in_question_) return known;
    for (std::size_t i = 0; i < size_; ++i) known += segments_[i].information;
    return known;
  }
  /// Multiplies the weight of all observations so far by `factor`.
  void forget(double factor) {
    earlier_.scale(factor);
    for (std::size_t i = 0; i < size_; ++i) segments_[i].information.scale(factor);
  }
  /// Accepts a change of the coefficients by w ~ N(0, diag(variance)).
  void release(const Vector& variance) {
    in_question_ = false;
    earlier_ = known().released(variance);
    size_ = 0;
  }
  void reset() {
    in_question_ = false;
    earlier_ = {};
    size_ = 0;
    next_weight_ = 1.0;
  }

 private:
  struct Segment {
    Information<N> information;
    double weight = 1.0;  ///< weight of observations at the begin of the segment
  };
  using Ratios = std::array<double, kKinds>;
  static constexpr std::size_t kNone = kSegments;
  static constexpr double kNoiseUncertainty =
      0.25;  ///< uncertainty of log odds due to unknown noise, relative

  void dropOldest() {
    earlier_ += segments_[0].information;
    for (std::size_t i = 1; i < size_; ++i) segments_[i - 1] = segments_[i];
    --size_;
  }

  /// Log evidence ratio of a change of each kind between `before` and `after` to no change.
  Ratios ratios(Information<N> before, Information<N> after, double weight) const {
    before.scale(weight);
    after.scale(weight);
    Information<N> whole = before;
    whole += after;
    const double same = whole.logEvidence(precision_) - before.logEvidence(precision_);
    Ratios ratios;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      const Information<N> released = before.released(kinds_[kind]);
      whole = released;
      whole += after;
      ratios[kind] = whole.logEvidence(precision_) - released.logEvidence(precision_) - same;
    }
    return ratios;
  }

  /// Segment before which a change has the largest log odds; kNone when none exceed log_odds.
  std::size_t likeliestChange() const {
    std::size_t likeliest = kNone;
    double best = log_odds_;
    Information<N> before = earlier_;
    for (std::size_t i = 0; i < size_; ++i) {
      if (i > 0) before += segments_[i - 1].information;
      if (before.count == 0) continue;
      Information<N> after = segments_[i].information;
      for (std::size_t k = i + 1; k < size_; ++k) after += segments_[k].information;
      for (const double ratio : ratios(before, after, segments_[i].weight))
        if (ratio > best) best = ratio, likeliest = i;
    }
    return likeliest;
  }

  /// Puts a change before segment `change` in question. The two segments next to the change are excluded,
  /// because the change may be inside them.
  void split(std::size_t change) {
    for (std::size_t i = 0; i + 1 < change; ++i) earlier_ += segments_[i].information;
    Segment after{{}, segments_[change].weight};
    for (std::size_t i = change + 1; i < size_; ++i) after.information += segments_[i].information;
    segments_[0] = after;
    size_ = 1;
    in_question_ = true;
  }

  int decide() {
    if (segments_[0].information.count == 0) return kInQuestion;
    const Ratios weighed = ratios(earlier_, segments_[0].information, segments_[0].weight);
    std::size_t kind = 0;
    for (std::size_t i = 1; i < kKinds; ++i)
      if (weighed[i] > weighed[kind]) kind = i;
    double second = 0.0;
    for (std::size_t i = 0; i < kKinds; ++i)
      if (i != kind) second = std::max(second, weighed[i]);
    if (weighed[kind] <= 0.0) {
      in_question_ = false;
      return kNoChange;
    }
    if (weighed[kind] - second < std::max(lead_, kNoiseUncertainty * weighed[kind])) return kInQuestion;
    in_question_ = false;
    earlier_ = earlier_.released(kinds_[kind]);
    next_weight_ = 1.0;
    return static_cast<int>(kind);
  }

  Vector precision_;
  Kinds kinds_;
  double log_odds_, lead_;
  Information<N> earlier_;
  std::array<Segment, kSegments> segments_;
  std::size_t size_ = 0;
  double next_weight_ = 1.0;
  bool in_question_ = false;
};

}  // namespace capstan::estimation
