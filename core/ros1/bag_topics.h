#pragma once

#include <string>
#include <vector>

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// Topics of a bag by their meaning. Empty: found automatically; "none": not used.
struct BagTopics {
  std::string motors;                 ///< sensor_msgs/JointState of the motors, or a RAVEN-II's raven_state
  std::string joints;                 ///< JointState of joints that the robot computes from its motors
  std::string encoders;               ///< JointState of joint encoders, the reference
  std::string left, right;            ///< sensor_msgs/Image or CompressedImage
  std::string left_info, right_info;  ///< sensor_msgs/CameraInfo
  std::string tip;                    ///< geometry_msgs/PointStamped in frame 0

  bool operator==(const BagTopics&) const = default;
};

/// Whether topics of this type carry motor positions: sensor_msgs/JointState, or a RAVEN-II's raven_state.
bool carriesMotors(const std::string& type);
/// Whether they carry joint positions: sensor_msgs/JointState.
bool isJointState(const std::string& type);
/// Whether they carry images: sensor_msgs/Image, CompressedImage.
bool carriesImages(const std::string& type);

/// Names that export and replay give to topics.
BagTopics ourTopics();
inline constexpr const char* kSessionTopic = "/capstan/session";  ///< std_msgs/String: SessionText

/// Parses "motors=/PSM1/actuators/measured_js,left=/camera/left". Throws base::InputError that names
/// `option`.
BagTopics parseBagTopics(const std::string& text, const std::string& option);

/// Completes `chosen` from the topics that there are:
/// motors: the only topic …/actuators/measured_js, else the only raven_state, else the only JointState;
/// joints: measured_js beside actuators; left, right: the only image topics with these words in their names;
/// left_info, right_info: camera_info beside the image. Throws base::InputError that lists the candidates
/// where the motors or the images are ambiguous, there are no motors, a chosen topic is not there or has
/// another type.
BagTopics completeTopics(const BagTopics& chosen, const std::vector<TopicType>& present);

}  // namespace capstan::ros1
