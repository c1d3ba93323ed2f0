#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/live/armed_drive.h"

namespace capstan::live {

/// What a person sees of the commands to a robot.
struct CommandStatus {
  DriveState state = DriveState::kDisarmed;
  std::string reason;           ///< of the last stop, or why it could not be armed; empty: none
  std::string topic;            ///< of the set-points
  std::uint64_t published = 0;  ///< messages since the session began
};

/// Commands to a real robot, as a person gives them. Any thread may call the functions.
class RobotCommands {
 public:
  virtual ~RobotCommands() = default;
  virtual void arm() = 0;  ///< in the background: status() has the result
  virtual void disarm() = 0;
  /// The dead-man's key is held; to be repeated at least every ArmedDrive::kHold.
  virtual void hold() = 0;
  virtual void release() = 0;
  virtual void stop(DriveStop cause) = 0;
  virtual CommandStatus status() const = 0;
};

/// A source whose robot may be commanded.
class Commandable {
 public:
  virtual ~Commandable() = default;
  /// Null: this one may not.
  virtual std::shared_ptr<RobotCommands> commands() const = 0;
};

}  // namespace capstan::live
