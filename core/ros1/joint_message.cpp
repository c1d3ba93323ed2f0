#include "core/ros1/joint_message.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/nan.h"

namespace capstan::ros1 {
namespace {

constexpr int kRavenJoints = 8;  // entries of an arm in a raven_state

double entry(const std::vector<double>& values, std::size_t index) {
  return index < values.size() ? values[index] : base::kNaN;
}

/// Index of each chosen motor in the message.
std::array<std::size_t, 3> indicesOf(const JointState& message, const MotorChoice& choice) {
  std::array<std::size_t, 3> indices = {0, 1, 2};
  for (std::size_t k = 0; k < choice.names.size() && k < 3; ++k) {
    const auto found = std::ranges::find(message.name, choice.names[k]);
    if (found == message.name.end())
      throw base::InputError(
          {{},
           0,
           "names",
           choice.names[k],
           fmt::format("is not in the message, which has: {}", fmt::join(message.name, ", ")),
           "Give three of these names, or none for the first three"});
    indices[k] = static_cast<std::size_t>(found - message.name.begin());
  }
  if (const std::size_t last = *std::ranges::max_element(indices); last >= message.position.size())
    throw base::InputError({{},
                            0,
                            "position",
                            fmt::format("{} entries", message.position.size()),
                            "has no entry for each of the three motors",
                            "Choose a topic with motor positions of a three-joint arm"});
  return indices;
}

bool anyFinite(const Eigen::Vector3d& value) { return value.array().isFinite().any(); }

std::vector<double> listOf(const Eigen::Vector3d& value) { return {value[0], value[1], value[2]}; }

}  // namespace

tracking::MotorSample motorOf(const JointState& message, const MotorChoice& choice, double t) {
  const std::array<std::size_t, 3> indices = indicesOf(message, choice);
  tracking::MotorSample sample{t, {}, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto motor = static_cast<Eigen::Index>(k);
    sample.position[motor] = (message.position[indices[k]] - choice.zero[k]) * choice.unit;
    sample.velocity[motor] = entry(message.velocity, indices[k]) * choice.unit;
    sample.torque[motor] = entry(message.effort, indices[k]);
  }
  return sample;
}

std::optional<tracking::JointSample> jointOf(const JointState& message, double t) {
  if (message.position.size() < 3) return {};
  const tracking::JointSample sample{t, {message.position[0], message.position[1], message.position[2]}};
  if (!sample.position.array().isFinite().all()) return {};
  return sample;
}

JointState messageOf(const tracking::MotorSample& sample, MessageHeader header) {
  JointState message{std::move(header), {"motor_1", "motor_2", "motor_3"}, listOf(sample.position), {}, {}};
  if (anyFinite(sample.velocity)) message.velocity = listOf(sample.velocity);
  if (anyFinite(sample.torque)) message.effort = listOf(sample.torque);
  return message;
}

JointState messageOf(const tracking::JointSample& sample, MessageHeader header) {
  return {std::move(header), {"joint_1", "joint_2", "joint_3"}, listOf(sample.position), {}, {}};
}

tracking::MotorSample motorOf(const RavenState& state, const robot::RavenSoftware& software, int arm,
                              double t) {
  tracking::MotorSample sample{t, {}, {}, {}};
  for (int motor = 0; motor < 3; ++motor) {
    const auto index = static_cast<std::size_t>(arm * kRavenJoints + motor);
    sample.position[motor] = software.motorPosition(motor, static_cast<double>(state.mpos[index]));
    sample.velocity[motor] = software.motorSpeed(motor, static_cast<double>(state.mvel[index]));
    sample.torque[motor] = static_cast<double>(state.tau[index]);
  }
  return sample;
}

tracking::JointSample jointOf(const RavenState& state, int arm, double t) {
  tracking::JointSample sample{t, {}};
  for (int joint = 0; joint < 3; ++joint)
    sample.position[joint] = robot::RavenSoftware::joint(
        static_cast<double>(state.jpos[static_cast<std::size_t>(arm * kRavenJoints + joint)]));
  return sample;
}

}  // namespace capstan::ros1
