#include "core/live/row_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/live/streams/tcp_listener.h"
#include "core/recording/table_source.h"
#include "core/ros1/stamp.h"

namespace capstan::live {

using State = tracking::SideStatus::State;

RowSide::RowSide(std::unique_ptr<RowInput> input, robot::Description robot, MotorArrangement arrangement,
                 bool reference, Faults faults, SampleQueue& queue)
    : input_(std::move(input)),
      robot_(std::move(robot)),
      arrangement_(std::move(arrangement)),
      reference_(reference),
      faults_(faults),
      queue_(queue) {
  status_.name = "motors";
  status_.from = input_->name();
  thread_ = std::thread([this] { work(); });
}

RowSide::~RowSide() {
  quit_ = true;
  queue_.close();
  thread_.join();
}

RowFacts RowSide::waitForFirst(double longest) {
  std::future<RowFacts> first = first_.get_future();
  constexpr double kYear = 3e7;  // the clock has no overflow
  const std::chrono::duration<double> wait(std::min(longest, kYear));
  if (first.wait_for(wait) == std::future_status::ready) return first.get();
  throw base::InputError({input_->name(),
                          0,
                          {},
                          {},
                          fmt::format("has given no row for {:g} s", longest),
                          "Check the program that writes the rows"});
}

void RowSide::rethrow() const {
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(fault_);
}

tracking::SideStatus RowSide::status() const {
  const std::lock_guard lock(mutex_);
  tracking::SideStatus status = status_;
  if (status.received > 0 && !held_up_) status.silent_for = now() - last_arrival_;
  if (status.state == State::kReceiving && status.silent_for > tracking::SideStatus::kSilence)
    status.state = State::kSilent;
  return status;
}

std::optional<double> RowSide::sessionTime(Clock::time_point at) const {
  const std::lock_guard lock(mutex_);
  if (status_.received == 0) return {};
  return clock_.toDevice(std::chrono::duration<double>(at - start_).count());
}

double RowSide::sessionBegin() const {
  const std::lock_guard lock(mutex_);
  return begin_;
}

double RowSide::newestTime() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::optional<double> RowSide::sessionTimeOfStamp(std::int64_t stamp) const {
  const std::lock_guard lock(mutex_);
  if (!ros_stamp_of_begin_) return {};
  return ros1::secondsOf(stamp - *ros_stamp_of_begin_);
}

int RowSide::clockSteps() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(clock_steps_);
}

void RowSide::work() {
  try {
    while (!quit_ && !ended_) readOnce();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    fault_ = std::current_exception();
    if (!first_known_) first_.set_exception(fault_), first_known_ = true;
  }
  if (!first_known_) first_.set_value({});
  {
    const std::lock_guard lock(mutex_);
    status_.state = State::kEnded;
  }
  queue_.close();
}

void RowSide::readOnce() {
  constexpr std::chrono::milliseconds kWait{50};
  const ReadState state = input_->read(kWait);
  try {
    if (state == ReadState::kOpened || state == ReadState::kReplaced) begin(state == ReadState::kReplaced);
    ended_ = state == ReadState::kEnded;
    if (auto rows = input_->take()) pass(std::move(*rows));
    if (state == ReadState::kNothing && !first_known_) noteHint();
    if (state != ReadState::kClosed && state != ReadState::kEnded) return;
    const std::lock_guard lock(mutex_);
    status_.incomplete = input_->incomplete();
    noticed_ = false;
    if (state == ReadState::kEnded) return;
    status_.state = State::kWaiting;
    status_.connected = false;
    status_.warning.clear(), status_.reason.clear();
  } catch (const base::InputError& error) {
    if (faults_ == Faults::kEnd) throw;
    refuse(error.what());
  }
}

void RowSide::noteHint() {
  const std::optional<std::string> hint = input_->hint();
  if (!hint) return;
  const std::lock_guard lock(mutex_);
  status_.reason = *hint;
}

void RowSide::begin(bool replaced) {
  motors_judged_ = noticed_ = false, beyond_ = 0;
  times_.reconnect();
  const std::lock_guard lock(mutex_);
  status_.warning.clear();
  ++status_.connections;
  status_.state = State::kWaiting;
  status_.connected = true;
  status_.reason.clear();
  if (!replaced) return;
  ++status_.refused;
  status_.fault = fmt::format("{}: a program without a valid row for {} s gave way to another one",
                              status_.from, TcpListener::kPatience.count());
}

/// Remarks on the first rows of a program.
void RowSide::notice(const recording::MeasuredTable& table) {
  if (faults_ == Faults::kEnd) return;  // RowFacts
  std::vector<std::string> notices = recording::noticesOf(table);
  const bool encoders_of_their_own = !input_->encoders().from.empty();
  if (reference_ && table.q.empty() && !encoders_of_their_own)
    notices.push_back(table.file + ": no joint encoders come: there is no reference");
  const std::lock_guard lock(mutex_);
  status_.notices = std::move(notices);
}

/// A motor that counts the other way leaves the limits of its joint only when the arm moves.
void RowSide::watchLimits(const recording::MeasuredTable& table) {
  if (!motors_judged_ || table.t.empty() || now() < limits_due_) return;
  limits_due_ = now() + 0.2;
  const std::string beyond = arrangement_.beyondLimits(table);
  beyond_ = beyond.empty() ? 0 : beyond_ + 1;
  constexpr int kToSay = 3;  // times in succession: a single row may be damaged
  const std::lock_guard lock(mutex_);
  status_.warning = beyond_ < kToSay ? std::string() : beyond;
}

void RowSide::pass(recording::MeasuredTable table) {
  recording::checkForTracking(table, robot_);
  if (!motors_judged_)
    motors_judged_ = faults_ == Faults::kShow ? arrangement_.checkUnits(table) : arrangement_.check(table);
  if (!std::exchange(noticed_, true)) notice(table);
  watchLimits(table);
  input_->confirm();
  if (!reference_) table.q.clear();
  if (faults_ == Faults::kEnd) {
    input_->checkOrder(table);
    return deliver(std::move(table), now());
  }
  std::vector<bool> keep(table.rows(), false);
  double arrival = now();
  for (std::size_t k = 0; k < table.rows() && !quit_; ++k) {
    if (times_.tooEarly(table.t[k], arrival) > 0.0) {
      deliverKept(table, keep, arrival);
      arrival = waitUntilDue(table.t[k]);
    }
    const auto time = times_.of(table.t[k], arrival);
    keep[k] = time.has_value();
    if (time) table.t[k] = *time;
  }
  deliverKept(std::move(table), keep, arrival);
}

/// Waits for a row that comes faster than real time, and meanwhile reads no further, so that its sender has
/// to wait, too. The publisher of a ROS topic does not wait: what comes meanwhile may be lost (noteLost()).
/// Returns the time at the end.
double RowSide::waitUntilDue(double stamp) {
  constexpr double kNap = 0.05;  // [s]; shorter ones would divide the rows into too many parts
  double arrival = now();
  for (double early = kNap; early > 0.0 && !quit_; early = times_.tooEarly(stamp, arrival)) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kNap));
    arrival = now();
  }
  return arrival;
}

/// Delivers the rows of `keep`, which is then empty.
void RowSide::deliverKept(recording::MeasuredTable table, std::vector<bool>& keep, double arrival) {
  recording::keepRows(table, keep);
  keep.assign(keep.size(), false);
  deliver(std::move(table), arrival);
}

void RowSide::deliver(recording::MeasuredTable table, double arrival) {
  if (table.rows() == 0) {
    const std::lock_guard lock(mutex_);
    status_.repeated = times_.repeated();
    if (status_.received > 0 && arrival - last_arrival_ > tracking::SideStatus::kSilence &&
        status_.repeated > repeated_before_)
      status_.reason = "the times t of the rows do not rise: check the clock of the sender";
    return;
  }
  std::uint64_t dropped = 0;
  if (!first_known_) {
    first_known_ = true;
    first_.set_value({!table.q.empty(), table.t.front(), recording::noticesOf(table)});
  }
  held_up_ = faults_ == Faults::kEnd;
  recording::RowSamples rows;
  for (tracking::Sample sample; rows.next(table, sample);) {
    if (faults_ == Faults::kEnd)
      queue_.wait(std::move(sample));
    else if (!queue_.offer(std::move(sample)))
      ++dropped;
  }
  const std::lock_guard lock(mutex_);
  if (std::exchange(clock_steps_, times_.steps()) != times_.steps()) clock_.forget();
  noteLost();
  if (const auto zero = input_->rosStampOfZero())
    ros_stamp_of_begin_ = *zero - ros1::nanosecondsOf(times_.offset());
  for (const double t : table.t) {
    // Rows from before a step have another offset from this computer's clock.
    if (t >= times_.timeOfLastStep()) clock_.add(t, arrival);
    gaps_.add(t);
  }
  if (status_.received == 0) begin_ = table.t.front();
  newest_ = table.t.back();
  status_.state = State::kReceiving;
  status_.reason.clear();
  status_.received += table.rows();
  status_.dropped += dropped;
  status_.repeated = times_.repeated();
  status_.missing = gaps_.missing();
  status_.gaps = gaps_.silences(), status_.last_gap = gaps_.lastSilence();
  status_.encoders = input_->encoders();
  repeated_before_ = status_.repeated;
  last_arrival_ = faults_ == Faults::kEnd ? now() : arrival;  // they may have waited for room
  held_up_ = false;
  if (faults_ == Faults::kEnd) return;
  status_.clock = tracking::SideClock{
      times_.steps(), times_.lastStep(),         clock_.offset(),   clock_.offsetUncertainty(),
      clock_.drift(), clock_.driftUncertainty(), clock_.meanDelay()};
}

/// Messages that the input has lost are dropped rows, and no missing ones.
void RowSide::noteLost() {
  const LostMessages before = std::exchange(lost_, input_->lost());
  gaps_.credit(lost_.rows - before.rows);
  status_.dropped += lost_.rows - before.rows + lost_.encoders - before.encoders;
}

void RowSide::refuse(const std::string& reason) {
  input_->refuse(reason);
  const std::lock_guard lock(mutex_);
  status_.state = State::kRefused;
  status_.connected = false;
  status_.warning.clear(), status_.reason.clear();
  ++status_.refused;
  status_.fault = reason;
}

}  // namespace capstan::live
