#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "core/base/names.h"
#include "core/robot/description.h"

namespace capstan::live {

/// Whether a robot may be commanded.
enum class DriveState {
  kDisarmed,  ///< nothing is sent
  kArmed,     ///< a person has armed the commands; nothing is sent until the dead-man's key is held
  kMoving,    ///< the key is held
  kStopped,   ///< nothing is sent until a person has armed the commands again
};

/// Reason of the last stop.
enum class DriveStop {
  kNone,
  kArrived,    ///< the arm is at the hard stop
  kByHand,     ///< button or key
  kFocus,      ///< the window has lost the focus
  kSilent,     ///< no motor positions for ArmedDrive::kSilence
  kEnded,      ///< the session was paused, has ended or was closed
  kOutside,    ///< a joint is outside its limits
  kStuck,      ///< the arm does not follow
  kDisagrees,  ///< the robot's own joint positions are not those of the motors
  kNoTopic,    ///< the topics cannot be used
};

/// Drives an arm to its hard stop by joint set-points, only where a person has armed it and while a
/// dead-man's key is held. It sends nothing itself and has no clock: times [s] of one rising clock come in as
/// arguments.
///
/// Set-points run on a straight line in joint space from the positions that are measured when the key is
/// pressed to q_hs. No joint is faster than its speed; the speed rises over kRamp and falls near the stop.
/// The line lies within the joint limits, widened to q_hs where that lies outside; a joint that is beyond
/// them by more than kMargin is not moved. A set-point moves away from the measured position by no more than
/// the joint's speed times kLead: where the arm is held up, the set-point waits.
class ArmedDrive {
 public:
  /// `speed`: largest speed of each joint [rad/s or m/s]; at most the robot file's max_speed is used.
  ArmedDrive(const robot::Description& robot, const std::array<double, 3>& speed);

  /// Measured joint positions [rad or m] at `now`.
  void observe(double now, const Eigen::Vector3d& q);
  /// From kDisarmed or kStopped. False, with the reason in stop(): no motor positions within kSilence, or a
  /// joint is outside its limits.
  bool arm(double now);
  void disarm();
  /// The dead-man's key is held at `now`; to be repeated at least every kHold.
  void hold(double now);
  void release();  ///< nothing more is sent from now on; kMoving → kArmed
  /// From kArmed and kMoving.
  void stop(DriveStop cause);
  /// The set-point to send at `now` [rad or m]; nothing: nothing may be sent.
  std::optional<Eigen::Vector3d> step(double now);

  DriveState state() const { return state_; }
  DriveStop cause() const { return cause_; }
  /// The last stop in words; empty: none.
  std::string reason() const;
  const Eigen::Vector3d& target() const { return target_; }      ///< q_hs [rad or m]
  const Eigen::Vector3d& lowest() const { return low_; }         ///< limits in use [rad or m]
  const Eigen::Vector3d& highest() const { return high_; }       ///< [rad or m]
  const Eigen::Vector3d& speed() const { return speed_; }        ///< in use [rad/s or m/s]
  const Eigen::Vector3d& measured() const { return measured_; }  ///< newest [rad or m]

  static constexpr double kSilence = 0.1;       ///< without motor positions the drive stops [s]
  static constexpr double kHold = 0.15;         ///< a held key that is not renewed counts as released [s]
  static constexpr double kRamp = 0.5;          ///< to full speed and from it [s]
  static constexpr double kLead = 0.25;         ///< of the set-point, in time at full speed [s]
  static constexpr double kStuck = 1.0;         ///< for which the set-point may wait [s]
  static constexpr double kSettle = 0.5;        ///< at the target before the drive has arrived [s]
  static constexpr double kLongestStep = 0.05;  ///< a later step moves no further than this one [s]
  /// Share of a joint's range by which it may be outside its limits: what cables and zeros are wrong by.
  static constexpr double kMargin = 0.05;

 private:
  bool isInside() const;
  bool isFresh(double now) const { return observed_ && now - observed_at_ <= kSilence; }
  void begin(double now);
  void advance(double passed, double now);

  Eigen::Vector3d target_, low_, high_, speed_;
  DriveState state_ = DriveState::kDisarmed;
  DriveStop cause_ = DriveStop::kNone;
  Eigen::Vector3d measured_ = Eigen::Vector3d::Zero(), point_ = Eigen::Vector3d::Zero();
  bool observed_ = false;
  double observed_at_ = 0.0, held_at_ = 0.0, moving_since_ = 0.0, stepped_at_ = 0.0;
  double advanced_at_ = 0.0;               ///< when the set-point has moved last
  std::optional<double> at_target_since_;  ///< of the set-point
};

}  // namespace capstan::live

template <>
struct capstan::base::NamesOf<capstan::live::DriveState> {
  using S = capstan::live::DriveState;
  static constexpr std::array value = {std::pair{S::kDisarmed, "disarmed"}, std::pair{S::kArmed, "armed"},
                                       std::pair{S::kMoving, "moving"}, std::pair{S::kStopped, "stopped"}};
};
template <>
struct capstan::base::NamesOf<capstan::live::DriveStop> {
  using S = capstan::live::DriveStop;
  static constexpr std::array value = {
      std::pair{S::kNone, "no stop"},
      std::pair{S::kArrived, "the arm is at the hard stop"},
      std::pair{S::kByHand, "stopped by hand"},
      std::pair{S::kFocus, "the window has lost the focus"},
      std::pair{S::kSilent, "no motor positions for 0.1 s"},
      std::pair{S::kEnded, "the session does not run"},
      std::pair{S::kOutside, "a joint is outside its limits: check zeros, signs and units"},
      std::pair{S::kStuck, "the arm does not follow the commands"},
      std::pair{S::kDisagrees, "the robot's own joint positions disagree with the motors"},
      std::pair{S::kNoTopic, "the topics of the commands cannot be used"}};
};
