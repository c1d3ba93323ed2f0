#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Messages of ROS 1 as plain data. This header and message_codec.cpp are C++17, because Debian's generated
/// message headers do not compile as C++20.
namespace capstan::ros1 {

using Bytes = std::vector<std::uint8_t>;

/// std_msgs/Header without its counter.
struct MessageHeader {
  std::int64_t stamp = 0;  ///< [ns], ROS time; 0: none
  std::string frame;
};

/// sensor_msgs/JointState.
struct JointState {
  MessageHeader header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};
/// sensor_msgs/Image.
struct Image {
  MessageHeader header;
  std::uint32_t height = 0, width = 0, step = 0;
  std::string encoding;
  bool big_endian = false;
  Bytes data;
};
/// sensor_msgs/CompressedImage.
struct CompressedImage {
  MessageHeader header;
  std::string format;
  Bytes data;
};
/// sensor_msgs/CameraInfo: distortion d, camera matrix k, rectification r, projection p; row by row.
struct CameraInfo {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
};
/// std_msgs/String.
struct Text {
  std::string data;
};
/// geometry_msgs/PointStamped.
struct PointStamped {
  MessageHeader header;
  std::array<double, 3> point{};
};
/// geometry_msgs/PoseStamped: position and quaternion x, y, z, w.
struct PoseStamped {
  MessageHeader header;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
};
/// geometry_msgs/PoseWithCovarianceStamped: covariance of x, y, z and rotations about x, y, z; row by row.
struct PoseWithCovarianceStamped {
  MessageHeader header;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 36> covariance{};
};

/// Name of a message's type, as sensor_msgs/JointState, the checksum of its definition, and the definition.
struct MessageType {
  std::string name, md5, definition;
};

/// A topic and the type of its messages.
struct TopicType {
  std::string topic, type;
};

}  // namespace capstan::ros1
