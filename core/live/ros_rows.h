#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>

#include "core/live/encoder_pairing.h"
#include "core/live/live_setup.h"
#include "core/live/row_input.h"
#include "core/live/topic_hint.h"
#include "core/ros1/joint_message.h"
#include "core/ros1/raven_state.h"
#include "core/ros1/ros_topics.h"

namespace capstan::live {

/// Motors as messages of a ROS topic: sensor_msgs/JointState (CRTK: …/actuators/measured_js), or the
/// RAVEN-II's raven_state, whose messages with a stamp of zero are excluded. Joint encoders of a second topic
/// come with the motors of their stamp.
class RosRows final : public RowInput {
 public:
  /// Throws base::InputError as TopicReader.
  RosRows(const RowsSetup& setup, const robot::Description& robot);

  std::string name() const override { return "ros:" + topic_; }
  ReadState read(std::chrono::milliseconds wait) override;
  std::optional<recording::MeasuredTable> take() override;
  void refuse(const std::string&) override { received_.clear(), received_encoders_.clear(); }
  void checkOrder(const recording::MeasuredTable&) override {}
  std::optional<std::string> hint() override;
  LostMessages lost() const override {
    return {motors_.lost(), encoders_ ? encoders_->lost() : std::uint64_t{0}};
  }
  tracking::EncoderStatus encoders() const override {
    tracking::EncoderStatus status = pairing_.status();
    status.from = encoders_from_;
    status.reason = encoders_reason_;
    return status;
  }
  std::optional<std::int64_t> rosStampOfZero() const override {
    return origin_ == 0 ? std::nullopt : std::optional(origin_);
  }

 private:
  template <class M>
  M decoded(const ros1::TopicMessage& message) const;
  void takeMotors(const ros1::TopicMessage& message);
  void takeEncoders(const ros1::TopicMessage& message);
  void noteSilentEncoders();
  double timeOf(std::int64_t stamp);

  const std::string topic_, encoders_from_;
  const ros1::MotorChoice choice_;
  const robot::RavenSoftware software_;
  ros1::TopicReader motors_;
  std::unique_ptr<ros1::TopicReader> encoders_;  ///< null: none
  std::optional<ros1::RavenStateLayout> raven_;
  std::int64_t origin_ = 0;  ///< first stamp [ns]; 0: none yet
  std::uint64_t connections_ = 0;
  TopicHint hint_, encoders_hint_;
  std::string encoders_reason_;  ///< why none come; empty: not known
  std::string encoders_type_;    ///< type of a message that cannot be used; empty: none came
  std::future<std::optional<std::string>> asked_;  ///< encoders_hint_, which has no other user meanwhile
  std::deque<ros1::TopicMessage> received_, received_encoders_;  ///< that take() has not decoded yet
  EncoderPairing pairing_;
};

}  // namespace capstan::live
