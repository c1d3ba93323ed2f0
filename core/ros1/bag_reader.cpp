#include "core/ros1/bag_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/ros1/bag_source.h"
#include "core/ros1/image_message.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/stamp.h"
#include "core/tracking/arrival.h"
#include "core/tracking/cover_frame.h"

namespace capstan::ros1 {
namespace {

constexpr double kPairing = 0.012;  // [s], half the period of 40 images per second

/// Order of samples that arrived at the same time: motors, joints, tips, images, as sources yield them.
int rankOf(const tracking::Sample& sample) {
  if (std::holds_alternative<tracking::MotorSample>(sample)) return 0;
  if (std::holds_alternative<tracking::JointSample>(sample)) return 1;
  return std::holds_alternative<tracking::TipSample>(sample) ? 2 : 3;
}

/// Does `work` on a message; its errors get the file and the time.
template <class Work>
auto naming(const std::filesystem::path& path, const BagMessage& message, Work&& work) {
  const std::string place =
      fmt::format("{}: {} at {:.6f} s", path.string(), message.topic, secondsOf(message.time));
  try {
    return base::namingFile(place, work);
  } catch (const base::InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw base::InputError({place,
                            0,
                            {},
                            {},
                            fmt::format("is no {}: {}", message.type, error.what()),
                            "Record the topic again, or choose another one with --topics"});
  }
}

}  // namespace

BagReader::BagReader(const std::filesystem::path& path, const robot::Description& robot,
                     const BagTopics& topics)
    : path_(path), file_(path), pairer_(kPairing) {
  base::namingFile(path.string(), [&] { topics_ = completeTopics(topics, file_.topics()); });
  readFacts(robot);
  readMotorBegin();
  readCalibration();
  file_.choose(sampleTopics());
  ahead_ = file_.next();
}

void BagReader::readFacts(const robot::Description& robot) {
  info_.title = path_.filename().string();
  info_.robot = robot;
  info_.own_kinematics = topics_.encoders.empty();
  info_.duration = secondsOf(file_.end() - file_.begin());
  file_.choose({kSessionTopic});
  if (const auto message = file_.next()) {
    const SessionText text =
        naming(path_, *message, [&] { return parseSessionText(decode<Text>(message->bytes).data, {}); });
    takeSessionText(text, path_.string(), info_);
    exact_ = text.epoch > 0;
    origin_ = arrival_origin_ = text.epoch * kSecond;
  }
  info_.reference = !topics_.joints.empty() || !topics_.encoders.empty();
  if (info_.robot.size() != 3)
    throw base::InputError(
        {path_.string(),
         0,
         {},
         {},
         fmt::format("is tracked with three joints, {} has {}", info_.robot.name, info_.robot.size()),
         "Choose the robot file of a three-joint arm"});
}

void BagReader::readMotorBegin() {
  file_.choose({topics_.motors});
  auto message = file_.next();
  if (!message)
    throw base::InputError({path_.string(), 0, "motors", topics_.motors, "has no message",
                            "Choose another topic with --topics motors=…"});
  if (isRavenState(message->type)) {
    naming(path_, *message, [&] { raven_.emplace(file_.definitionOf(topics_.motors)); });
    software_.emplace(info_.robot);
    info_.reference = info_.own_kinematics = true;
  }
  if (exact_) return;
  std::int64_t stamp = 0;
  for (; message && stamp == 0; message = file_.next()) {
    stamp = naming(path_, *message, [&] {
      return raven_ ? raven_->read(message->bytes).stamp : decode<JointState>(message->bytes).header.stamp;
    });
    arrival_origin_ = message->time;
    if (stamp == 0 && !raven_) stamp = message->time;
  }
  origin_ = stamp;
  info_.begin = 0.0;
}

void BagReader::readCalibration() {
  if (topics_.left.empty() != topics_.right.empty())
    throw base::InputError({path_.string(),
                            0,
                            topics_.left.empty() ? "left" : "right",
                            {},
                            "has no images, the other camera has",
                            "Choose its topic with --topics, or none for both: left=none,right=none"});
  if (topics_.left.empty()) return;
  std::array<std::string, 2> texts;
  const std::array infos = {topics_.left_info, topics_.right_info};
  for (std::size_t side = 0; side < 2; ++side) {
    std::optional<BagMessage> message;
    if (!infos[side].empty()) file_.choose({infos[side]}), message = file_.next();
    if (!message)
      throw base::InputError({path_.string(), 0, side == 0 ? "left_info" : "right_info", infos[side],
                              "has no sensor_msgs/CameraInfo, without which images cannot be used",
                              "Record camera_info, too, choose it with --topics, or leave the images out: "
                              "--topics left=none,right=none"});
    texts[side] =
        naming(path_, *message, [&] { return calibrationTextOf(decode<CameraInfo>(message->bytes)); });
  }
  info_.rig = base::namingFile(path_.string(), [&] { return vision::parseStereoRig(texts[0], texts[1]); });
}

std::vector<std::string> BagReader::sampleTopics() const {
  std::vector<std::string> topics;
  for (const std::string* topic :
       {&topics_.motors, &topics_.joints, &topics_.encoders, &topics_.left, &topics_.right, &topics_.tip})
    if (!topic->empty()) topics.push_back(*topic);
  return topics;
}

bool BagReader::next(tracking::Sample& out) {
  while (samples_.empty()) {
    if (!ahead_) return false;
    readGroup();
  }
  out = std::move(samples_.front());
  samples_.pop_front();
  if (auto* tip = std::get_if<tracking::TipSample>(&out); tip && (blocked_[0] || blocked_[1]))
    tip->position.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (auto* frame = std::get_if<tracking::StereoFrame>(&out)) tracking::coverFrame(*frame, blocked_);
  return true;
}

/// Reads the messages of one time of recording.
void BagReader::readGroup() {
  const std::int64_t time = ahead_->time;
  while (ahead_ && ahead_->time == time) {
    naming(path_, *ahead_, [&] { take(*ahead_); });
    ahead_ = file_.next();
  }
  if (images_) samples_.emplace_back(std::move(*images_)), images_.reset();
  std::ranges::stable_sort(samples_, {}, rankOf);
}

double BagReader::timeOf(std::int64_t stamp, double arrival) const {
  return stamp == 0 ? arrival : secondsOf(stamp - origin_);
}

void BagReader::take(const BagMessage& message) {
  const double arrival = secondsOf(message.time - arrival_origin_);
  if (message.topic == topics_.motors) {
    takeMotors(message, arrival);
  } else if (message.topic == topics_.left || message.topic == topics_.right) {
    takeImage(message, message.topic == topics_.right, arrival);
  } else if (message.topic == topics_.tip) {
    const auto tip = decode<PointStamped>(message.bytes);
    const double t = timeOf(tip.header.stamp, arrival);
    samples_.emplace_back(
        tracking::TipSample{t, std::max(t, arrival), {tip.point[0], tip.point[1], tip.point[2]}});
  } else {
    const auto joints = decode<JointState>(message.bytes);
    if (const auto sample = jointOf(joints, timeOf(joints.header.stamp, arrival)))
      samples_.emplace_back(*sample);
  }
}

void BagReader::takeMotors(const BagMessage& message, double arrival) {
  if (!raven_) {
    const auto motors = decode<JointState>(message.bytes);
    samples_.emplace_back(motorOf(motors, {}, timeOf(motors.header.stamp, arrival)));
    return;
  }
  const RavenState state = raven_->read(message.bytes);
  if (state.stamp == 0) return;  // no valid state
  const double t = timeOf(state.stamp, arrival);
  samples_.emplace_back(motorOf(state, *software_, 0, t));
  samples_.emplace_back(jointOf(state, 0, t));
}

void BagReader::takeImage(const BagMessage& message, int side, double arrival) {
  MessageHeader header;
  cv::Mat image;
  if (message.type == "sensor_msgs/Image") {
    const auto decoded = decode<Image>(message.bytes);
    header = decoded.header, image = imageOf(decoded);
  } else {
    const auto decoded = decode<CompressedImage>(message.bytes);
    header = decoded.header, image = imageOf(decoded);
  }
  const double t = timeOf(header.stamp, arrival);
  if (exact_) {  // both eyes have one time of recording
    if (!images_) images_ = tracking::StereoFrame{t, arrival, {}, {}};
    (side == 0 ? images_->left : images_->right) = image;
  } else if (auto pair = pairer_.add(side, t, image)) {
    samples_.emplace_back(tracking::StereoFrame{pair->t, std::max(pair->t, arrival), std::move(pair->left),
                                                std::move(pair->right)});
  }
}

std::unique_ptr<tracking::Source> openBag(const std::filesystem::path& path, const robot::Description& robot,
                                          const BagTopics& topics) {
  return std::make_unique<BagReader>(path, robot, topics);
}

}  // namespace capstan::ros1
