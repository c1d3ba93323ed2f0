#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstring>

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// A message of any type, serialised. As a subscriber it matches every type.
struct RawMessage {
  MessageType type{"*", "*", ""};
  Bytes bytes;
};

}  // namespace capstan::ros1

namespace ros {
namespace message_traits {

template <>
struct IsMessage<capstan::ros1::RawMessage> : TrueType {};
template <>
struct IsMessage<const capstan::ros1::RawMessage> : TrueType {};
template <>
struct MD5Sum<capstan::ros1::RawMessage> {
  static const char* value(const capstan::ros1::RawMessage& message) { return message.type.md5.c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct DataType<capstan::ros1::RawMessage> {
  static const char* value(const capstan::ros1::RawMessage& message) { return message.type.name.c_str(); }
  static const char* value() { return "*"; }
};
template <>
struct Definition<capstan::ros1::RawMessage> {
  static const char* value(const capstan::ros1::RawMessage& message) {
    return message.type.definition.c_str();
  }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<capstan::ros1::RawMessage> {
  template <class Stream>
  static void write(Stream& stream, const capstan::ros1::RawMessage& message) {
    if (!message.bytes.empty())
      std::memcpy(stream.advance(static_cast<std::uint32_t>(message.bytes.size())), message.bytes.data(),
                  message.bytes.size());
  }
  template <class Stream>
  static void read(Stream& stream, capstan::ros1::RawMessage& message) {
    const std::uint32_t size = stream.getLength();
    message.bytes.resize(size);
    if (size > 0) std::memcpy(message.bytes.data(), stream.advance(size), size);
  }
  static std::uint32_t serializedLength(const capstan::ros1::RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros
