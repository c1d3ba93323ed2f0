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

template <class From, class To>
void copyNumbers(const From& from, To& to) {
  std::copy(from.begin(), from.end(), to.begin());
}

void wireOf(const JointState& m, sensor_msgs::JointState& wire) {
  wire.header = wireOf(m.header);
  wire.name = m.name, wire.position = m.position, wire.velocity = m.velocity, wire.effort = m.effort;
}

void wireOf(const Image& m, sensor_msgs::Image& wire) {
  wire.header = wireOf(m.header);
  wire.height = m.height, wire.width = m.width, wire.step = m.step;
  wire.encoding = m.encoding, wire.is_bigendian = m.big_endian, wire.data = m.data;
}

void wireOf(const CompressedImage& m, sensor_msgs::CompressedImage& wire) {
  wire.header = wireOf(m.header);
  wire.format = m.format, wire.data = m.data;
}

void wireOf(const CameraInfo& m, sensor_msgs::CameraInfo& wire) {
  wire.header = wireOf(m.header);
  wire.height = m.height, wire.width = m.width;
  wire.distortion_model = m.distortion_model, wire.D = m.d;
  copyNumbers(m.k, wire.K), copyNumbers(m.r, wire.R), copyNumbers(m.p, wire.P);
}

void wireOf(const Text& m, std_msgs::String& wire) { wire.data = m.data; }

void wireOf(const PointStamped& m, geometry_msgs::PointStamped& wire) {
  wire.header = wireOf(m.header);
  wire.point.x = m.point[0], wire.point.y = m.point[1], wire.point.z = m.point[2];
}

template <class M>
geometry_msgs::Pose poseOf(const M& m) {
  geometry_msgs::Pose pose;
  pose.position.x = m.position[0], pose.position.y = m.position[1], pose.position.z = m.position[2];
  pose.orientation.x = m.orientation[0], pose.orientation.y = m.orientation[1];
  pose.orientation.z = m.orientation[2], pose.orientation.w = m.orientation[3];
  return pose;
}
void wireOf(const PoseStamped& m, geometry_msgs::PoseStamped& wire) {
  wire.header = wireOf(m.header), wire.pose = poseOf(m);
}
void wireOf(const PoseWithCovarianceStamped& m, geometry_msgs::PoseWithCovarianceStamped& wire) {
  wire.header = wireOf(m.header), wire.pose.pose = poseOf(m);
  copyNumbers(m.covariance, wire.pose.covariance);
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

}  // namespace

#define CAPSTAN_ROS_MESSAGE(M, Wire)  \
  template <>                         \
  const MessageType& typeOf<M>() {    \
    return typeOfWire<Wire>();        \
  }                                   \
  template <>                         \
  Bytes encode<M>(const M& message) { \
    return encodeAs<Wire>(message);   \
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
