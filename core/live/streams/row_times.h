#pragma once

#include <cstdint>
#include <optional>

namespace capstan::live {

/// Times of rows that come in real time, on the session's clock. That clock starts at 0 with the first row
/// and never goes back: where the rows' own clock steps, or another program sends on, it goes on by the time
/// that has passed here.
class RowTimes {
 public:
  /// Time of a row [s]; nothing if the row is repeated or older than the one before. `stamp`: its own time
  /// [s]; `arrival`: on this computer [s].
  std::optional<double> of(double stamp, double arrival);
  std::uint64_t steps() const { return steps_; }        ///< steps of the rows' clock so far
  double lastStep() const { return last_step_; }        ///< size of the last one, positive: ahead [s]
  std::uint64_t repeated() const { return repeated_; }  ///< rows excluded so far

  static constexpr double kBack = 0.1;   ///< a clock that goes back by more has stepped [s]
  static constexpr double kAhead = 0.3;  ///< the same for one that goes ahead of the arrivals [s]

 private:
  bool started_ = false;
  double offset_ = 0.0, stamp_ = 0.0, arrival_ = 0.0, last_step_ = 0.0;
  double time_ = -1.0;  ///< the newest on the session's clock; it begins at 0
  std::uint64_t steps_ = 0, repeated_ = 0;
};

}  // namespace capstan::live
