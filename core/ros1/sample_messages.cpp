#include "core/ros1/sample_messages.h"

#include "core/ros1/image_message.h"
#include "core/ros1/joint_message.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/session_text.h"

namespace capstan::ros1 {
namespace {

template <class M>
OutMessage outOf(const std::string& topic, const M& message) {
  return {topic, &typeOf<M>(), encode(message)};
}

}  // namespace

SampleMessages::SampleMessages(const tracking::SourceInfo& info) : info_(info) {
  if (info_.rig) cameras_ = messagesOf(*info_.rig);
}

std::vector<std::pair<std::string, const MessageType*>> SampleMessages::topics() const {
  std::vector<std::pair<std::string, const MessageType*>> all = {{topics_.motors, &typeOf<JointState>()}};
  if (info_.reference)
    all.emplace_back(info_.own_kinematics ? topics_.joints : topics_.encoders, &typeOf<JointState>());
  if (!info_.rig) {
    all.emplace_back(topics_.tip, &typeOf<PointStamped>());
    return all;
  }
  for (const std::string* topic : {&topics_.left, &topics_.right}) all.emplace_back(*topic, &typeOf<Image>());
  for (const std::string* topic : {&topics_.left_info, &topics_.right_info})
    all.emplace_back(*topic, &typeOf<CameraInfo>());
  return all;
}

std::vector<OutMessage> SampleMessages::of(const tracking::Sample& sample, std::int64_t stamp) const {
  std::vector<OutMessage> out;
  if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
    out.push_back(outOf(topics_.motors, messageOf(*motor, {stamp, "motors"})));
  } else if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) {
    out.push_back(outOf(info_.own_kinematics ? topics_.joints : topics_.encoders,
                        messageOf(*joint, {stamp, "joints"})));
  } else if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) {
    out.push_back(outOf(
        topics_.tip, PointStamped{{stamp, "base"}, {tip->position[0], tip->position[1], tip->position[2]}}));
  } else {
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    addImage(frame.left, 0, stamp, out);
    addImage(frame.right, 1, stamp, out);
  }
  return out;
}

void SampleMessages::addImage(const cv::Mat& image, std::size_t side, std::int64_t stamp,
                              std::vector<OutMessage>& out) const {
  if (image.empty()) return;
  CameraInfo info = cameras_[side];
  info.header.stamp = stamp;
  out.push_back(outOf(side == 0 ? topics_.left : topics_.right, messageOf(image, info.header)));
  if (info.width > 0) out.push_back(outOf(side == 0 ? topics_.left_info : topics_.right_info, info));
}

std::vector<OutMessage> SampleMessages::calibration(std::int64_t stamp) const {
  std::vector<OutMessage> out;
  for (std::size_t side = 0; side < 2 && info_.rig; ++side) {
    CameraInfo info = cameras_[side];
    info.header.stamp = stamp;
    out.push_back(outOf(side == 0 ? topics_.left_info : topics_.right_info, info));
  }
  return out;
}

OutMessage SampleMessages::session(int epoch) const {
  return outOf(kSessionTopic, Text{formatSessionText(info_, epoch)});
}

}  // namespace capstan::ros1
