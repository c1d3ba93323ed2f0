#pragma once

#include <atomic>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/motor_arrangement.h"
#include "core/live/row_input.h"
#include "core/live/sample_queue.h"
#include "core/live/streams/clock_map.h"
#include "core/live/streams/row_times.h"
#include "core/stats/gap_counter.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// Facts about a stream's rows that are known from the first ones.
struct RowFacts {
  bool reference = false;            ///< they have joint encoders
  double begin = 0.0;                ///< time of the first row [s]
  std::vector<std::string> notices;  ///< units and columns that are not used
};

/// Reads rows of a measured table on a thread of its own and puts their samples into a queue.
/// The rows' own clock is the session's clock.
class RowSide {
 public:
  enum class Faults {
    kEnd,         ///< a fault ends the stream, like that of a file: rethrow() reports it
    kDisconnect,  ///< a fault disconnects the program that made it; another one may connect
    kShow,        ///< the same, but positions outside the joints' limits are no fault: they are warned of
  };
  /// `arrangement` judges the first rows of every program; the samples stay as they came.
  /// `reference`: columns q are joint encoders; else they are not used.
  RowSide(std::unique_ptr<RowInput> input, robot::Description robot, MotorArrangement arrangement,
          bool reference, Faults faults, SampleQueue& queue);
  ~RowSide();

  /// Waits up to `longest` [s] for the first rows. Throws what rethrow() throws, and base::InputError where
  /// none come.
  RowFacts waitForFirst(double longest);
  /// Throws the fault that has ended the stream, if there was one.
  void rethrow() const;
  tracking::SideStatus status() const;
  /// Time on the session's clock at a time of this computer; nothing before the first rows.
  std::optional<double> sessionTime(std::chrono::steady_clock::time_point at) const;
  /// Time of the first row on the session's clock [s]; 0 before it.
  double sessionBegin() const;
  /// Time of the newest row on the session's clock [s]; 0 before the first one.
  double newestTime() const;
  /// Time on the session's clock of a stamp of the ROS clock [ns], by the newest rows; nothing where the rows
  /// have no such stamps.
  std::optional<double> sessionTimeOfStamp(std::int64_t stamp) const;
  int clockSteps() const;  ///< of the rows' own clock, so far

 private:
  using Clock = std::chrono::steady_clock;

  void work();
  void readOnce();
  void noteHint();
  void begin(bool replaced);
  void notice(const recording::MeasuredTable& table);
  void watchLimits(const recording::MeasuredTable& table);
  void pass(recording::MeasuredTable table);
  double waitUntilDue(double stamp);
  void deliverKept(recording::MeasuredTable table, std::vector<bool>& keep, double arrival);
  void deliver(recording::MeasuredTable table, double arrival);
  void noteLost();
  void refuse(const std::string& reason);
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  std::unique_ptr<RowInput> input_;
  const robot::Description robot_;
  const MotorArrangement arrangement_;
  const bool reference_;
  const Faults faults_;
  SampleQueue& queue_;
  const Clock::time_point start_ = Clock::now();
  RowTimes times_;
  std::promise<RowFacts> first_;
  bool first_known_ = false, ended_ = false;
  bool motors_judged_ = false, noticed_ = false;  ///< those of the program that is connected
  double limits_due_ = 0.0;                       ///< next time of watchLimits() [s]
  int beyond_ = 0;  ///< times in succession that it found a joint beyond its limits
  std::atomic<bool> quit_{false};
  std::atomic<bool> held_up_{false};  ///< waits for room in the queue: the sender is not silent

  mutable std::mutex mutex_;  ///< protects the members below
  tracking::SideStatus status_;
  stats::GapCounter gaps_;                          ///< in the session's times
  LostMessages lost_;                               ///< of the input, that status_ and gaps_ know
  ClockMap clock_;                                  ///< from the session's clock to this computer's
  double begin_ = 0.0, newest_ = 0.0;               ///< time of the first and the newest row [s]
  std::uint64_t clock_steps_ = 0;                   ///< of times_ that clock_ knows
  std::uint64_t repeated_before_ = 0;               ///< excluded before the newest row
  double last_arrival_ = 0.0;                       ///< [s] after start_
  std::optional<std::int64_t> ros_stamp_of_begin_;  ///< of time 0 of the session [ns]
  std::exception_ptr fault_;

  std::thread thread_;
};

}  // namespace capstan::live
