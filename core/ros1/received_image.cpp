#include "core/ros1/received_image.h"

#include "core/base/error.h"
#include "core/ros1/image_message.h"
#include "core/ros1/message_codec.h"

namespace capstan::ros1 {
namespace {

template <class M>
StampedImage decoded(const TopicMessage& message) {
  M decoded;
  try {
    decoded = decode<M>(message.bytes);
  } catch (const std::exception& error) {
    throw base::InputError({{},
                            0,
                            {},
                            message.type,
                            std::string("is damaged: ") + error.what(),
                            "Check the program that publishes it"});
  }
  return {decoded.header.stamp, imageOf(decoded)};
}

}  // namespace

StampedImage imageOf(const TopicMessage& message) {
  if (message.type == "sensor_msgs/Image") return decoded<Image>(message);
  if (message.type == "sensor_msgs/CompressedImage") return decoded<CompressedImage>(message);
  throw base::InputError({{},
                          0,
                          {},
                          message.type,
                          "is no image",
                          "Choose a topic of type sensor_msgs/Image or sensor_msgs/CompressedImage"});
}

}  // namespace capstan::ros1
