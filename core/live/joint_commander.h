#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/armed_drive.h"
#include "core/live/live_setup.h"
#include "core/live/robot_commands.h"
#include "core/ros1/message_data.h"

namespace capstan::live {

/// Publishes the set-points of an ArmedDrive on a ROS topic (CRTK servo_jp or move_jp,
/// sensor_msgs/JointState) on a thread of its own. The topic is not even advertised before the drive is
/// armed, nor after it is disarmed. A message is published only while the lock is held under which the drive
/// was asked: after release() or stop() has returned, no other one is published. Any thread may call the
/// functions.
class JointCommander final : public RobotCommands {
 public:
  /// Throws base::InputError for a robot of fewer than three joints.
  JointCommander(const CommandsSetup& setup, const robot::Description& robot);
  ~JointCommander() override;  ///< stops

  /// Joint positions by the motors of a sample [rad or m] that arrived at `arrival`; called for every one. A
  /// session that lags is like one without motors.
  void observe(const Eigen::Vector3d& q, std::chrono::steady_clock::time_point arrival);
  void arm() override;
  void disarm() override;
  void hold() override;
  void release() override;
  void stop(DriveStop cause) override;
  CommandStatus status() const override;

  /// Between two messages.
  static constexpr std::chrono::milliseconds kServoPeriod{10}, kMovePeriod{50};

 private:
  using Clock = std::chrono::steady_clock;
  class Topics;

  void work();
  void openTopics(std::unique_lock<std::mutex>& lock);
  void publish(const Eigen::Vector3d& point);
  void fail(DriveStop cause, std::string what);
  double timeOf(Clock::time_point at) const { return std::chrono::duration<double>(at - start_).count(); }
  double now() const { return timeOf(Clock::now()); }

  const CommandsSetup setup_;
  const std::vector<std::string> joints_;  ///< names in the message
  const Clock::time_point start_ = Clock::now();
  mutable std::mutex mutex_;  ///< protects the members below
  std::condition_variable changed_;
  ArmedDrive drive_;
  std::unique_ptr<Topics> topics_;  ///< while armed
  bool wants_arming_ = false, quit_ = false;
  std::string detail_;  ///< of the last stop
  std::uint64_t published_ = 0;

  std::thread thread_;
};

/// The message of a set-point: one joint for each of `names`, or the robot's own message `measured` with
/// three positions replaced, where it has more joints than the three. Its positions are sign q + offset.
/// Throws base::InputError where `measured` lacks one of the names.
ros1::JointState commandOf(const CommandsSetup& setup, const std::vector<std::string>& names,
                           const Eigen::Vector3d& point, const ros1::JointState* measured);
/// The joint of 1, 2, 3 whose position in the robot's message differs from `q` by more than `tolerance`, in
/// words with both numbers; empty: none.
std::string disagreementOf(const CommandsSetup& setup, const std::vector<std::string>& names,
                           const Eigen::Vector3d& q, const Eigen::Vector3d& tolerance,
                           const ros1::JointState& measured);

}  // namespace capstan::live
