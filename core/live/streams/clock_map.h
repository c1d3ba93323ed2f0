#pragma once

#include <array>
#include <cstddef>
#include <deque>

namespace capstan::live {

/// Estimate of a device's clock from pairs of its stamps and the times of arrival. An arrival is the stamp on
/// the session's clock plus a delay that is never below the smallest one:
///     arrival = stamp + offset + drift (stamp − stamp₀) + delay.
/// offset and drift are the line below all pairs that is nearest to them (Moon, Skelly and Towsley,
/// Estimation and removal of clock skew from network delay measurements, INFOCOM 1999): the lower convex hull
/// at the mean stamp, with at most kMostDrift. The smallest delay cannot be distinguished from an offset; it
/// counts as offset.
///
/// A stall makes pairs late, and a burst follows; the stamps go on evenly. A clock that steps makes the
/// stamps jump: back, or ahead by more than the time that has passed between the arrivals. Only such a jump
/// begins the search for a step. Late pairs without one lie above the line and do not move it. Pairs below
/// the line without one show that all earlier pairs were late: the line begins again with them.
class ClockMap {
 public:
  /// Adds a stamp [s, device] and its arrival [s, session]. `stream`: which of up to kStreams streams of the
  /// device it comes from; arrivals of a stream are in the order of their stamps. Returns true if the clock
  /// has stepped: the stamps of the stream have jumped, and all its pairs of the kStepTime since then differ
  /// from the line by more than kStep; the estimate then restarts with these pairs.
  bool add(double stamp, double arrival, std::size_t stream = 0);
  /// Whether the stamps of the stream have jumped, and none since then has been near the line: the newest one
  /// is wrong, or the first ones of a step.
  bool jumped(std::size_t stream = 0) const { return streams_.at(stream).jumped; }
  /// Begins again with the next pair: the clock is known to have changed. The number of steps stays.
  void forget();
  /// The stamp on the session's clock [s], and the inverse.
  double toSession(double stamp) const;
  double toDevice(double session) const;

  double offset() const;                            ///< session − device at the newest stamp [s]
  double offsetUncertainty() const;                 ///< standard deviation [s]
  double drift() const { return slope_; }           ///< gain of the session's clock on the device's [s/s]
  double driftUncertainty() const;                  ///< standard deviation [s/s]
  double meanDelay() const { return mean_delay_; }  ///< above the smallest one, of the last pairs [s]
  int steps() const { return steps_; }              ///< number of steps of the clock

  static constexpr double kWindow = 60.0;  ///< age of the pairs in use [s]
  static constexpr double kBin = 0.5;   ///< of each such interval the pair of the smallest delay is used [s]
  static constexpr double kStep = 0.1;  ///< smallest step of a clock that is recognised [s]
  static constexpr double kStepTime = 0.5;    ///< for which all pairs have to show it [s]
  static constexpr double kMostDrift = 2e-4;  ///< of two quartz clocks, each within 100 ppm [s/s]
  /// Pairs that are all later than the first for the second [s] are no backlog: the line begins again.
  static constexpr double kTooLate = 1.0, kTooLateFor = 2.0;
  /// For this time after its begin the line may still be that of a backlog with lost pairs [s].
  static constexpr double kSettling = 2.0;
  static constexpr std::size_t kStreams = 2;

 private:
  struct Pair {
    double stamp = 0.0, delay = 0.0;  ///< delay: arrival − stamp
    int count = 1;                    ///< number of pairs that it stands for
  };
  struct Stream {
    double stamp = 0.0, arrival = 0.0;  ///< of its newest pair
    bool started = false;
    bool jumped = false;  ///< its stamps have jumped, and no pair has been near the line since then
  };
  /// Pairs that have differed from the line since a time.
  struct Deviation {
    bool on = false;
    double since = 0.0;  ///< arrival of the first one
    Pair lowest;         ///< the one with the smallest delay
    /// Takes another pair; true: for at least `time`.
    bool lasts(const Pair& pair, double time);
  };
  void restart(const Pair& pair);
  bool jumps(const Stream& stream, double stamp, double arrival) const;
  void take(const Pair& pair, double above);
  void fit();
  double errorOfEnd() const;  ///< RMS error of the line at either of the pairs on which it lies [s]
  double span() const;        ///< of the pairs in use [s]
  double line(double stamp) const { return level_ + slope_ * (stamp - origin_); }

  std::deque<Pair> bins_;  ///< of each kBin the pair with the smallest delay, in order of the stamps
  double bin_begin_ = 0.0;
  double origin_ = 0.0, level_ = 0.0, slope_ = 0.0;  ///< delay = level + slope (stamp − origin)
  double begun_ = 0.0, newest_ = 0.0, mean_delay_ = 0.0;
  std::array<Stream, kStreams> streams_;
  Deviation stepped_, late_;
  bool started_ = false;
  int steps_ = 0, pairs_ = 0;
};

}  // namespace capstan::live
