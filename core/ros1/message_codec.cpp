// C++17: see message_data.h.
#include "core/ros1/message_codec.h"

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/serialization.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>

#include <algorithm>

namespace capstan::ros1 {
namespace {

constexpr std::int64_t kSecond = 1000000000;

std_msgs::Header wireOf(const MessageHeader& header) {
  std_msgs::Header wire;
  wire.stamp.sec = static_cast<std::uint32_t>(header.stamp / kSecond);
  wire.stamp.nsec = static_cast<std::uint32_t>(header.stamp % kSecond);
  wire.frame_id = header.frame;
  return wire;
}
MessageHeader plainOf(const std_msgs::Header& wire) {
  return {static_cast<std::int64_t>(wire.stamp.sec) * kSecond + wire.stamp.nsec, wire.frame_id};
}

template <class From, class To>
void copyNumbers(const From& from, To& to) {
  std::copy(from.begin(), from.end(), to.begin());
}

void wireOf(const JointState& m, sensor_msgs::JointState& wire) {
  wire.header = wireOf(m.header);
  wire.name = m.name, wire.position = m.position, wire.velocity = m.velocity, wire.effort = m.effort;
}
void plainOf(sensor_msgs::JointState& wire, JointState& m) {
  m = {plainOf(wire.header), std::move(wire.name), std::move(wire.position), std::move(wire.velocity),
       std::move(wire.effort)};
}

void wireOf(const Image& m, sensor_msgs::Image& wire) {
  wire.header = wireOf(m.header);
  wire.height = m.height, wire.width = m.width, wire.step = m.step;
  wire.encoding = m.encoding, wire.is_bigendian = m.big_endian, wire.data = m.data;
}
void plainOf(sensor_msgs::Image& wire, Image& m) {
  m = {plainOf(wire.header),     wire.height,           wire.width,          wire.step,
       std::move(wire.encoding), wire.is_bigendian > 0, std::move(wire.data)};
}

void wireOf(const CompressedImage& m, sensor_msgs::CompressedImage& wire) {
  wire.header = wireOf(m.header);
  wire.format = m.format, wire.data = m.data;
}
void plainOf(sensor_msgs::CompressedImage& wire, CompressedImage& m) {
  m = {plainOf(wire.header), std::move(wire.format), std::move(wire.data)};
}

void wireOf(const CameraInfo& m, sensor_msgs::CameraInfo& wire) {
  wire.header = wireOf(m.header);
  wire.height = m.height, wire.width = m.width;
  wire.distortion_model = m.distortion_model, wire.D = m.d;
  copyNumbers(m.k, wire.K), copyNumbers(m.r, wire.R), copyNumbers(m.p, wire.P);
}
void plainOf(sensor_msgs::CameraInfo& wire, CameraInfo& m) {
  m.header = plainOf(wire.header);
  m.height = wire.height, m.width = wire.width;
  m.distortion_model = wire.distortion_model, m.d = wire.D;
  copyNumbers(wire.K, m.k), copyNumbers(wire.R, m.r), copyNumbers(wire.P, m.p);
}

void wireOf(const Text& m, std_msgs::String& wire) { wire.data = m.data; }
void plainOf(std_msgs::String& wire, Text& m) { m.data = std::move(wire.data); }

void wireOf(const PointStamped& m, geometry_msgs::PointStamped& wire) {
  wire.header = wireOf(m.header);
  wire.point.x = m.point[0], wire.point.y = m.point[1], wire.point.z = m.point[2];
}
void plainOf(geometry_msgs::PointStamped& wire, PointStamped& m) {
  m = {plainOf(wire.header), {wire.point.x, wire.point.y, wire.point.z}};
}

template <class M>
geometry_msgs::Pose poseOf(const M& m) {
  geometry_msgs::Pose pose;
  pose.position.x = m.position[0], pose.position.y = m.position[1], pose.position.z = m.position[2];
  pose.orientation.x = m.orientation[0], pose.orientation.y = m.orientation[1];
  pose.orientation.z = m.orientation[2], pose.orientation.w = m.orientation[3];
  return pose;
}
template <class M>
void takePose(const geometry_msgs::Pose& pose, M& m) {
  m.position = {pose.position.x, pose.position.y, pose.position.z};
  m.orientation = {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w};
}
void wireOf(const PoseStamped& m, geometry_msgs::PoseStamped& wire) {
  wire.header = wireOf(m.header), wire.pose = poseOf(m);
}
void plainOf(geometry_msgs::PoseStamped& wire, PoseStamped& m) {
  m.header = plainOf(wire.header);
  takePose(wire.pose, m);
}
void wireOf(const PoseWithCovarianceStamped& m, geometry_msgs::PoseWithCovarianceStamped& wire) {
  wire.header = wireOf(m.header), wire.pose.pose = poseOf(m);
  copyNumbers(m.covariance, wire.pose.covariance);
}
void plainOf(geometry_msgs::PoseWithCovarianceStamped& wire, PoseWithCovarianceStamped& m) {
  m.header = plainOf(wire.header);
  takePose(wire.pose.pose, m);
  copyNumbers(wire.pose.covariance, m.covariance);
}

template <class Wire>
const MessageType& typeOfWire() {
  static const MessageType type{ros::message_traits::datatype<Wire>(), ros::message_traits::md5sum<Wire>(),
                                ros::message_traits::definition<Wire>()};
  return type;
}

template <class Wire, class M>
Bytes encodeAs(const M& message) {
  Wire wire;
  wireOf(message, wire);
  Bytes bytes(ros::serialization::serializationLength(wire));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, wire);
  return bytes;
}

template <class Wire, class M>
M decodeAs(const Bytes& bytes) {
  Wire wire;
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, wire);
  M message;
  plainOf(wire, message);
  return message;
}

}  // namespace

#define CAPSTAN_ROS_MESSAGE(M, Wire)     \
  template <>                            \
  const MessageType& typeOf<M>() {       \
    return typeOfWire<Wire>();           \
  }                                      \
  template <>                            \
  Bytes encode<M>(const M& message) {    \
    return encodeAs<Wire>(message);      \
  }                                      \
  template <>                            \
  M decode<M>(const Bytes& bytes) {      \
    return decodeAs<Wire, M>(bytes);     \
  }

CAPSTAN_ROS_MESSAGE(JointState, sensor_msgs::JointState)
CAPSTAN_ROS_MESSAGE(Image, sensor_msgs::Image)
CAPSTAN_ROS_MESSAGE(CompressedImage, sensor_msgs::CompressedImage)
CAPSTAN_ROS_MESSAGE(CameraInfo, sensor_msgs::CameraInfo)
CAPSTAN_ROS_MESSAGE(Text, std_msgs::String)
CAPSTAN_ROS_MESSAGE(PointStamped, geometry_msgs::PointStamped)
CAPSTAN_ROS_MESSAGE(PoseStamped, geometry_msgs::PoseStamped)
CAPSTAN_ROS_MESSAGE(PoseWithCovarianceStamped, geometry_msgs::PoseWithCovarianceStamped)

#undef CAPSTAN_ROS_MESSAGE

}  // namespace capstan::ros1
