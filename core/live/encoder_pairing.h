#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "core/tracking/sample.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// Joins joint encoders, which come as messages of their own, to the motors of their stamp. Stamps of one
/// cycle agree within kSameTime: encoders of another time would be a reference that is late or early by up to
/// a cycle, and are not used. Pairing restarts where the stamps of encoders step back, as in a bag that is
/// played again. Rows do not wait for encoders that have been silent for SideStatus::kSilence.
class EncoderPairing {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kSameTime = 2e-4;                      ///< [s]
  static constexpr auto kWait = tracking::EncoderStatus::kWait;  ///< of motors for their encoders
  static constexpr std::size_t kMost = 4000;  ///< encoders that wait for motors: 4 s of 1 kHz
  static constexpr double kLate = 1.0;        ///< encoders that are behind by more are of another clock [s]
  /// Number of consecutive unmatched rows, or late messages, after which `State` changes.
  static constexpr std::uint64_t kConsecutive = 50;

  struct Row {
    Clock::time_point arrival;
    tracking::MotorSample motors;
    std::optional<tracking::JointSample> joints;
  };

  /// `awaited`: encoders come; else a row is complete as it is.
  explicit EncoderPairing(bool awaited) : awaited_(awaited) {}

  void addMotors(Row row) {
    // Where both were silent, encoders come with the next rows.
    if (!newest_arrival_ || row.arrival - *newest_arrival_ > kSilence) heard_ = row.arrival;
    newest_arrival_ = row.arrival;
    rows_.push_back(std::move(row));
  }
  void addEncoders(const tracking::JointSample& joints, Clock::time_point arrival) {
    heard_ = arrival;
    if (joints.t < newest_encoders_ - kSameTime) joints_.clear(), newest_row_ = kNever;
    newest_encoders_ = joints.t;
    if (joints.t < newest_row_ + kSameTime && joints.t > newest_row_ - kLate) {  // its row has gone
      ++status_.late, ++consecutive_late_;
      return;
    }
    joints_.push_back({joints, false});
    if (joints_.size() > kMost) dropOldest();
  }
  /// Moves the oldest row to `row`, if it need not wait for its encoders any more at the time `now`.
  bool take(Clock::time_point now, Row& row) {
    if (rows_.empty()) return false;
    silent_ = awaited_ && now - *heard_ > kSilence;
    if (!isComplete(rows_.front(), now)) return false;
    row = std::move(rows_.front());
    rows_.pop_front();
    const double t = newest_row_ = row.motors.t;
    while (!joints_.empty() && joints_.front().sample.t < t - kSameTime) dropOldest();
    if (!joints_.empty() && joints_.front().sample.t < t + kSameTime) {
      row.joints = joints_.front().sample;
      joints_.front().used = true;
      consecutive_unmatched_ = consecutive_late_ = 0;
    }
    if (std::exchange(passed_over_, false) && !row.joints) ++status_.unmatched, ++consecutive_unmatched_;
    return true;
  }
  bool empty() const { return rows_.empty(); }
  /// Unmatched are rows without encoders before which encoders came that belong to no row: the stamps of the
  /// two do not agree. Topics of different rates, and messages that are lost, do not count.
  tracking::EncoderStatus status() const {
    using State = tracking::EncoderStatus::State;
    tracking::EncoderStatus status = status_;
    if (consecutive_late_ >= kConsecutive) status.state = State::kLate;
    if (consecutive_unmatched_ >= kConsecutive) status.state = State::kOtherStamps;
    if (silent_) status.state = State::kSilent;
    return status;
  }

 private:
  struct Encoders {
    tracking::JointSample sample;
    bool used = false;
  };

  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  static constexpr std::chrono::duration<double> kSilence{tracking::SideStatus::kSilence};

  bool isComplete(const Row& row, Clock::time_point now) const {
    return !awaited_ || silent_ || (!joints_.empty() && joints_.back().sample.t > row.motors.t - kSameTime) ||
           now - row.arrival > kWait;
  }
  void dropOldest() {
    passed_over_ = passed_over_ || !joints_.front().used;
    joints_.pop_front();
  }

  const bool awaited_;
  std::deque<Row> rows_;
  std::deque<Encoders> joints_;
  bool passed_over_ = false;  ///< encoders that belong to no row, since the last row
  double newest_row_ = kNever, newest_encoders_ = kNever;           ///< taken, and come [s]
  tracking::EncoderStatus status_;                                  ///< its counts
  std::uint64_t consecutive_unmatched_ = 0, consecutive_late_ = 0;  ///< since the last match
  std::optional<Clock::time_point> newest_arrival_;                 ///< of a row
  std::optional<Clock::time_point>
      heard_;            ///< arrival of the newest encoders, or of the first row after a silence
  bool silent_ = false;  ///< encoders, when the newest row was taken
};

}  // namespace capstan::live
