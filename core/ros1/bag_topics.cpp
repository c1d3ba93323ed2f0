#include "core/ros1/bag_topics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>

#include "core/base/error.h"
#include "core/ros1/raven_state.h"

namespace capstan::ros1 {

bool isJointState(const std::string& type) { return type == "sensor_msgs/JointState"; }

bool carriesMotors(const std::string& type) { return isJointState(type) || isRavenState(type); }

bool carriesImages(const std::string& type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

namespace {

constexpr const char* kOption = "--topics";
constexpr const char* kActuators = "/actuators/measured_js";
constexpr const char* kNone = "none";

struct Role {
  const char* name;
  std::string BagTopics::*topic;
  bool (*fits)(const std::string& type);
  const char* types;
};

bool isInfo(const std::string& type) { return type == "sensor_msgs/CameraInfo"; }
bool isPoint(const std::string& type) { return type == "geometry_msgs/PointStamped"; }

const std::array kRoles = {
    Role{"motors", &BagTopics::motors, carriesMotors, "sensor_msgs/JointState or raven_state"},
    Role{"joints", &BagTopics::joints, isJointState, "sensor_msgs/JointState"},
    Role{"encoders", &BagTopics::encoders, isJointState, "sensor_msgs/JointState"},
    Role{"left", &BagTopics::left, carriesImages, "sensor_msgs/Image or sensor_msgs/CompressedImage"},
    Role{"right", &BagTopics::right, carriesImages, "sensor_msgs/Image or sensor_msgs/CompressedImage"},
    Role{"left_info", &BagTopics::left_info, isInfo, "sensor_msgs/CameraInfo"},
    Role{"right_info", &BagTopics::right_info, isInfo, "sensor_msgs/CameraInfo"},
    Role{"tip", &BagTopics::tip, isPoint, "geometry_msgs/PointStamped"}};

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& reason,
                         const std::string& remedy) {
  throw base::InputError({{}, 0, key, value, reason, remedy});
}

std::vector<std::string> topicsOf(const std::vector<TopicType>& present,
                                  const std::function<bool(const TopicType&)>& fits) {
  std::vector<std::string> topics;
  for (const TopicType& one : present)
    if (fits(one)) topics.push_back(one.topic);
  std::ranges::sort(topics);
  return topics;
}

bool contains(const std::vector<TopicType>& present, const std::string& topic,
              bool (*fits)(const std::string&)) {
  return std::ranges::any_of(present,
                             [&](const TopicType& one) { return one.topic == topic && fits(one.type); });
}

std::string example(const char* role, const std::vector<std::string>& candidates) {
  return fmt::format("Choose one, as in {} {}={}", kOption, role, candidates.front());
}

void findMotors(BagTopics& topics, const std::vector<TopicType>& present) {
  const auto joint_states = topicsOf(present, [](const TopicType& one) { return isJointState(one.type); });
  const auto ravens = topicsOf(present, [](const TopicType& one) { return isRavenState(one.type); });
  const auto actuators = topicsOf(present, [](const TopicType& one) {
    return isJointState(one.type) && one.topic.ends_with(kActuators);
  });
  for (const auto* candidates : {&actuators, &ravens, &joint_states})
    if (candidates->size() == 1) {
      topics.motors = candidates->front();
      return;
    }
  const auto all = topicsOf(present, [](const TopicType& one) { return carriesMotors(one.type); });
  if (all.empty()) {
    std::vector<std::string> words;
    for (const TopicType& one : present) words.push_back(one.topic + " (" + one.type + ")");
    refuse({}, {},
           "has no topic with motor positions; its topics are: " +
               (words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "))),
           "Record a sensor_msgs/JointState of the motors (CRTK: …/actuators/measured_js) or a ravenstate");
  }
  refuse("motors", {}, fmt::format("could be {}", fmt::join(all, " or ")), example("motors", all));
}

/// Topic beside another one: `topic` up to the slash before its last `parts` parts, and `name`.
std::string beside(std::string topic, int parts, const std::string& name) {
  for (; parts > 0; --parts) topic.resize(std::min(topic.rfind('/'), topic.size()));
  return topic + "/" + name;
}

void findJoints(BagTopics& topics, const std::vector<TopicType>& present) {
  if (!topics.joints.empty() || !topics.encoders.empty() || !topics.motors.ends_with(kActuators)) return;
  const std::string joints = beside(topics.motors, 2, "measured_js");
  if (contains(present, joints, isJointState)) topics.joints = joints;
}

void findImage(std::string& topic, const char* word, const std::vector<TopicType>& present) {
  if (!topic.empty()) return;
  const auto images = topicsOf(present, [&](const TopicType& one) {
    return carriesImages(one.type) && one.topic.find(word) != std::string::npos;
  });
  const auto raw = topicsOf(present, [&](const TopicType& one) {
    return one.type == "sensor_msgs/Image" && one.topic.find(word) != std::string::npos;
  });
  if (images.size() == 1 || raw.size() == 1)
    topic = raw.size() == 1 ? raw.front() : images.front();
  else if (!images.empty())
    refuse(word, {}, fmt::format("could be {}", fmt::join(images, " or ")),
           example(word, images) + fmt::format("; {}=none for no images", word));
}

void findInfo(std::string& info, const std::string& image, const std::vector<TopicType>& present) {
  if (!info.empty() || image.empty() || image == kNone) return;
  for (const int parts : {1, 2})  // …/image_raw, …/image_raw/compressed
    if (const std::string topic = beside(image, parts, "camera_info"); contains(present, topic, isInfo)) {
      info = topic;
      return;
    }
}

void checkChosen(const BagTopics& topics, const std::vector<TopicType>& present) {
  for (const Role& role : kRoles) {
    const std::string& topic = topics.*role.topic;
    if (topic.empty() || topic == kNone || contains(present, topic, role.fits)) continue;
    const auto fitting = topicsOf(present, [&](const TopicType& one) { return role.fits(one.type); });
    const bool there = std::ranges::find(present, topic, &TopicType::topic) != present.end();
    refuse(role.name, topic, there ? fmt::format("is not of type {}", role.types) : "is not in the bag",
           fitting.empty() ? "The bag has no topic of that type"
                           : fmt::format("Choose one of: {}", fmt::join(fitting, ", ")));
  }
}

}  // namespace

BagTopics ourTopics() {
  return {.motors = "/arm/actuators/measured_js",
          .joints = "/arm/measured_js",
          .encoders = "/arm/encoders/measured_js",
          .left = "/stereo/left/image_raw",
          .right = "/stereo/right/image_raw",
          .left_info = "/stereo/left/camera_info",
          .right_info = "/stereo/right/camera_info",
          .tip = "/arm/tip"};
}

BagTopics parseBagTopics(const std::string& text, const std::string& option) {
  BagTopics topics;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equal = part.find('=');
    const std::string name = part.substr(0, equal);
    const auto role = std::ranges::find_if(kRoles, [&](const Role& one) { return one.name == name; });
    if (role == kRoles.end() || equal == std::string::npos || equal + 1 == part.size())
      refuse(option, part, "names no topic",
             "Write NAME=TOPIC with NAME one of motors, joints, encoders, left, right, left_info, "
             "right_info, tip");
    topics.*(role->topic) = part.substr(equal + 1);
    if (topics.*(role->topic) != kNone && part[equal + 1] != '/')
      refuse(option, part, "has a topic that does not begin with /", "Write it as rosbag info shows it");
  }
  return topics;
}

BagTopics completeTopics(const BagTopics& chosen, const std::vector<TopicType>& present) {
  BagTopics topics = chosen;
  if (topics.motors.empty()) findMotors(topics, present);
  checkChosen(topics, present);
  findJoints(topics, present);
  findImage(topics.left, "left", present);
  findImage(topics.right, "right", present);
  findInfo(topics.left_info, topics.left, present);
  findInfo(topics.right_info, topics.right, present);
  if (topics.tip.empty() && contains(present, ourTopics().tip, isPoint)) topics.tip = ourTopics().tip;
  if (topics.encoders.empty() && contains(present, ourTopics().encoders, isJointState))
    topics.encoders = ourTopics().encoders;
  for (const Role& role : kRoles)
    if (topics.*role.topic == kNone) (topics.*role.topic).clear();
  return topics;
}

}  // namespace capstan::ros1
