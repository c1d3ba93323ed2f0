#pragma once

#include <deque>

namespace capstan::live {

/// Estimate of a device's clock from pairs of its stamps and the times of arrival. An arrival is the stamp on
/// the session's clock plus a delay that is never below the smallest one:
///     arrival = stamp + offset + drift (stamp − stamp₀) + delay.
/// offset and drift are the line below all pairs that is nearest to them (Moon, Skelly and Towsley,
/// Estimation and removal of clock skew from network delay measurements, INFOCOM 1999): the lower convex hull
/// at the mean stamp. The smallest delay cannot be distinguished from an offset; it counts as offset.
class ClockMap {
 public:
  /// Adds a stamp [s, device] and its arrival [s, session]. Returns true if the clock has stepped: all pairs
  /// of the last kStepTime differ from the line by more than kStep; the estimate then restarts with these
  /// pairs.
  bool add(double stamp, double arrival);
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
  static constexpr double kStepTime = 0.5;  ///< for which all pairs have to show it [s]

 private:
  struct Pair {
    double stamp = 0.0, delay = 0.0;  ///< delay: arrival − stamp
    int count = 1;                    ///< number of pairs that it stands for
  };
  void restart(double stamp, double delay);
  void fit();
  double errorOfEnd() const;  ///< RMS error of the line at either of the pairs on which it lies [s]
  double span() const;        ///< of the pairs in use [s]
  double line(double stamp) const { return level_ + slope_ * (stamp - origin_); }

  std::deque<Pair> bins_;  ///< of each kBin the pair with the smallest delay, in order of the stamps
  double bin_begin_ = 0.0;
  double origin_ = 0.0, level_ = 0.0, slope_ = 0.0;  ///< delay = level + slope (stamp − origin)
  double newest_ = 0.0, mean_delay_ = 0.0;
  double deviating_since_ = 0.0;  ///< arrival of the first pair that shows a step
  Pair nearest_;                  ///< of these the one that is nearest to the line
  bool deviating_ = false, started_ = false;
  int steps_ = 0, pairs_ = 0;
};

}  // namespace capstan::live
