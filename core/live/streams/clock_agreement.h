#pragma once

#include <optional>

#include "core/live/streams/clock_map.h"

namespace capstan::live {

/// Decides whether the stamps of images and those of motor samples are by one clock. Both are mapped to this
/// computer's clock by their arrivals. `lateness` is the time of a pair of images by the arrivals minus that
/// by the stamps. With one clock it is the smallest delay of the images less that of the motor samples.
///
/// Up to kLate, images of a busy computer or network are later than from one whose clock is another: they are
/// dated by the stamps, which at worst makes them too late for the filter, where the arrivals would date them
/// wrongly. After an image that was no later than kLatest, after a step of a clock, and once the clocks
/// differ, the limit is kLatest. Farther out, up to kFar, both are possible, and the images have no time
/// until that has lasted for kDecide.
///
/// Arrivals of a computer that stalls are late by seconds, on one side or on both. Clocks that have agreed
/// for kPairs therefore agree until one of them steps, or until the lateness, followed by kDrift at most as
/// two quartz clocks would drift apart, is farther out than kMargin.
class ClockAgreement {
 public:
  enum class Verdict { kUndecided, kAgree, kDiffer };

  /// Adds the lateness [s] of the pair of images at time `t` [s]; `steps`: number of steps of both clocks so
  /// far.
  Verdict add(double lateness, int steps, double t);
  /// Forgets all pairs: one of the sides has no stamps now.
  void forget() { pairs_ = 0; }

  static constexpr double kEarliest = -0.02, kLatest = 0.25;  ///< lateness with one clock [s]
  static constexpr double kLate = 2.0;                        ///< the same, until one of these cases [s]
  static constexpr double kFar = 10.0;                        ///< no delay, either way [s]
  static constexpr double kDecide = 2.0;                      ///< [s]
  static constexpr int kPairs = 20;                           ///< 1 s of 20 pairs/s
  static constexpr double kDrift = ClockMap::kMostDrift;      ///< [s/s]
  static constexpr double kMargin = 0.1;                      ///< [s]

 private:
  bool follows(double lateness, double t);

  int pairs_ = 0;          ///< that have agreed, one after the other; up to kPairs
  int steps_ = 0;          ///< of the last pair
  double latest_ = kLate;  ///< [s]
  bool decided_ = false;
  std::optional<double> apart_since_;         ///< [s]
  double followed_ = 0.0, followed_t_ = 0.0;  ///< lateness at the drift of clocks, and its time [s]
};

}  // namespace capstan::live
