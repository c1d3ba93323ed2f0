#include "core/live/ros_rows.h"

#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/ros1/bag_topics.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/stamp.h"

namespace capstan::live {
namespace {

constexpr std::size_t kCapacity = 4000;  // messages: 4 s of 1 kHz

ros1::MotorChoice choiceOf(const RowsSetup& setup) { return {setup.names, 1.0, setup.zero, setup.arm - 1}; }

void push(recording::TableColumns& columns, const Eigen::Vector3d& value) {
  columns.resize(3);
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)].push_back(value[i]);
}

void dropEmpty(recording::TableColumns& columns) {
  for (const auto& column : columns)
    for (const double x : column)
      if (std::isfinite(x)) return;
  columns.clear();
}

}  // namespace

RosRows::RosRows(const RowsSetup& setup, const robot::Description& robot)
    : topic_(rosTopicOf(setup.from)),
      encoders_from_(setup.encoders.empty() ? "" : "ros:" + setup.encoders),
      choice_(choiceOf(setup)),
      software_(robot),
      motors_(topic_, kCapacity),
      encoders_(setup.encoders.empty() ? nullptr
                                       : std::make_unique<ros1::TopicReader>(setup.encoders, kCapacity)),
      hint_(topic_, ros1::carriesMotors, "motors"),
      encoders_hint_(setup.encoders, ros1::isJointState, "joint encoders"),
      pairing_(encoders_ != nullptr) {}

ReadState RosRows::read(std::chrono::milliseconds wait) {
  constexpr std::chrono::milliseconds kNow{0}, kSoon{1};
  for (auto message = motors_.next(pairing_.empty() ? wait : kSoon); message; message = motors_.next(kNow))
    received_.push_back(std::move(*message));
  for (auto message = encoders_ ? encoders_->next(kNow) : std::nullopt; message;
       message = encoders_->next(kNow))
    received_encoders_.push_back(std::move(*message));
  const std::uint64_t connections = motors_.connections();
  if (std::exchange(connections_, connections) != connections) return ReadState::kOpened;
  return received_.empty() ? ReadState::kNothing : ReadState::kBytes;
}

std::optional<std::string> RosRows::hint() {
  if (connections_ > 0) return {};
  std::optional<std::string> why = hint_.ask();
  if (why && why->empty()) why = topic_ + " is published, yet no message has come";
  return why;
}

double RosRows::timeOf(std::int64_t stamp) {
  if (origin_ == 0) origin_ = stamp;
  return ros1::secondsOf(stamp - origin_);
}

/// Throws base::InputError for bytes that are no message of the type.
template <class M>
M RosRows::decoded(const ros1::TopicMessage& message) const {
  try {
    return ros1::decode<M>(message.bytes);
  } catch (const std::exception& error) {
    throw base::InputError({name(),
                            0,
                            {},
                            message.type,
                            std::string("is damaged: ") + error.what(),
                            "Check the program that publishes it"});
  }
}

void RosRows::takeMotors(const ros1::TopicMessage& message) {
  if (ros1::isRavenState(message.type)) {
    if (!raven_) raven_.emplace(message.definition);
    const ros1::RavenState state = raven_->read(message.bytes);
    if (state.stamp == 0) return;  // no valid state
    const double t = timeOf(state.stamp);
    // Where encoders come, the robot's own kinematics must not stand in for one that is missing.
    const auto own = encoders_ ? std::nullopt : std::optional(ros1::jointOf(state, choice_.arm, t));
    pairing_.addMotors({message.arrival, ros1::motorOf(state, software_, choice_.arm, t), own});
    return;
  }
  if (message.type != "sensor_msgs/JointState")
    throw base::InputError({"ros:" + topic_,
                            0,
                            {},
                            message.type,
                            "is no message of motors",
                            "Choose a topic of type sensor_msgs/JointState or raven_state"});
  const auto state = decoded<ros1::JointState>(message);
  const std::int64_t stamp = state.header.stamp != 0 ? state.header.stamp : ros1::rosTimeNow();
  pairing_.addMotors({message.arrival, ros1::motorOf(state, choice_, timeOf(stamp)), {}});
}

void RosRows::takeEncoders(const ros1::TopicMessage& message) {
  if (!ros1::isJointState(message.type)) {
    encoders_type_ = message.type;
    return;
  }
  encoders_type_.clear();
  const auto state = decoded<ros1::JointState>(message);
  const double t = timeOf(state.header.stamp != 0 ? state.header.stamp : ros1::rosTimeNow());
  if (const auto joints = ros1::jointOf(state, t)) pairing_.addEncoders(*joints, message.arrival);
}

/// Asks the master why no encoders come, as long as nobody has published any: on a thread of its own, since
/// motors come meanwhile.
void RosRows::noteSilentEncoders() {
  const bool silent = pairing_.status().state == tracking::EncoderStatus::State::kSilent;
  if (asked_.valid()) {
    if (asked_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    encoders_reason_ = asked_.get().value_or(encoders_reason_);
  }
  if (silent && !encoders_type_.empty())
    encoders_reason_ = "its type is " + encoders_type_ + ", which carries no joint positions";
  else if (!silent || encoders_->connections() > 0)
    encoders_reason_.clear();
  else if (encoders_hint_.isDue())
    asked_ = std::async(std::launch::async, [this] { return encoders_hint_.ask(); });
}

std::optional<recording::MeasuredTable> RosRows::take() {
  for (; !received_.empty(); received_.pop_front()) takeMotors(received_.front());
  for (; !received_encoders_.empty(); received_encoders_.pop_front())
    takeEncoders(received_encoders_.front());
  noteSilentEncoders();
  recording::MeasuredTable table;
  table.file = name();
  table.own_kinematics = raven_.has_value();
  for (EncoderPairing::Row row; pairing_.take(std::chrono::steady_clock::now(), row);) {
    table.t.push_back(row.motors.t);
    push(table.q_m, row.motors.position);
    push(table.dq_m, row.motors.velocity);
    push(table.tau_m, row.motors.torque);
    push(table.q, row.joints ? row.joints->position : Eigen::Vector3d::Constant(base::kNaN));
  }
  if (table.t.empty()) return {};
  for (recording::TableColumns* columns : {&table.dq_m, &table.tau_m, &table.q}) dropEmpty(*columns);
  return table;
}

}  // namespace capstan::live
