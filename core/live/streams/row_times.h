#pragma once

#include <cstdint>
#include <optional>

namespace capstan::live {

/// Times of rows that come in real time, on the session's clock. That clock starts at 0 with the first row
/// and never goes back: where the rows' own clock steps (back: by two rows in succession), or another program
/// sends on, it goes on by the time that has passed here. It is never ahead of this computer's clock by more
/// than kAhead: rows whose stamps lie in the future do not run it on. Where rows come faster than real time,
/// whoever reads them has to wait (tooEarly()); a row that comes too early nevertheless is a step of the
/// rows' clock.
class RowTimes {
 public:
  /// Time of a row [s]; nothing if the row is repeated or older than the one before. `stamp`: its own time
  /// [s]; `arrival`: on this computer [s].
  std::optional<double> of(double stamp, double arrival);
  /// For how long a row has to wait, since it comes faster than real time [s]; 0: it is due, or its stamp has
  /// jumped.
  double tooEarly(double stamp, double arrival) const;
  /// The next row is the first one of another connection: a stamp that does not rise is a step of the clock.
  void reconnect() { reconnected_ = true; }
  /// Time on the session's clock minus the stamp, of the newest row [s].
  double offset() const { return offset_; }
  /// Time of the row at which the rows' clock has stepped last [s]; 0: none.
  double timeOfLastStep() const { return time_of_step_; }
  std::uint64_t steps() const { return steps_; }        ///< steps of the rows' clock so far
  double lastStep() const { return last_step_; }        ///< size of the last one, positive: ahead [s]
  std::uint64_t repeated() const { return repeated_; }  ///< rows excluded so far

  static constexpr double kBack = 0.1;   ///< a clock that goes back by more has stepped [s]
  static constexpr double kAhead = 0.3;  ///< the same for one that goes ahead of the arrivals [s]

  /// A clock may be faster than this computer's by this share, so that what it is ahead by grows [s/s].
  static constexpr double kFast = 0.01;
  /// The first row may have waited for as long as the first: for the second after it, later rows may be ahead
  /// of it by so much [s].
  static constexpr double kFirstWait = 2.0, kSettling = 2.0;

 private:
  double aheadBy(double time, double arrival) const;
  bool goesOn(double stamp) const;
  void follow(double time, double arrival);

  bool started_ = false, reconnected_ = false;
  double offset_ = 0.0, stamp_ = 0.0, arrival_ = 0.0, last_step_ = 0.0, time_of_step_ = 0.0;
  std::optional<double>
      back_;            ///< stamp of a row that was far behind the one before: late, or the clock has stepped
  double time_ = 0.0;   ///< of the newest row on the session's clock [s]
  double begun_ = 0.0;  ///< arrival of the first row [s]
  double lead_ = 0.0;   ///< of the session's clock on this computer's since the first row, as usual [s]
  std::uint64_t steps_ = 0, repeated_ = 0;
};

}  // namespace capstan::live
