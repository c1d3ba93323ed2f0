#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/raven_software.h"
#include "core/ros1/message_data.h"
#include "core/ros1/raven_state.h"
#include "core/tracking/sample.h"

namespace capstan::ros1 {

/// Choice of three motors of a message.
struct MotorChoice {
  std::vector<std::string> names;  ///< in a sensor_msgs/JointState, in our order; empty: its first three
  double unit = 1.0;               ///< radians per unit of the message's positions
  std::array<double, 3> zero{};    ///< position in the message at the hard stop
  int arm = 0;                     ///< of a raven_state: 0 the first, 1 the second
};

/// Motor sample of a JointState at t [s]: position (x − zero) unit, velocity x unit, torque the effort; NaN
/// where the message has none. Throws base::InputError with the names that the message has if it lacks one.
tracking::MotorSample motorOf(const JointState& message, const MotorChoice& choice, double t);
/// Joint sample of the first three positions of a JointState at t [s]; nothing if it has fewer, or if one is
/// not finite.
std::optional<tracking::JointSample> jointOf(const JointState& message, double t);
/// The inverse of both.
JointState messageOf(const tracking::MotorSample& sample, MessageHeader header);
JointState messageOf(const tracking::JointSample& sample, MessageHeader header);

/// Motors and joints of a raven_state at t [s]. The joints are the robot's own kinematics.
tracking::MotorSample motorOf(const RavenState& state, const robot::RavenSoftware& software, int arm,
                              double t);
tracking::JointSample jointOf(const RavenState& state, int arm, double t);

}  // namespace capstan::ros1
