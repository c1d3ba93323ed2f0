#include "core/ros1/receive_rig.h"

#include <array>

#include "core/base/error.h"
#include "core/ros1/image_message.h"
#include "core/ros1/master_topics.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/ros_topics.h"

namespace capstan::ros1 {
namespace {

constexpr const char* kType = "sensor_msgs/CameraInfo";
constexpr std::chrono::milliseconds kAnswer{700};  ///< of the master

[[noreturn]] void refuse(const std::string& topic) {
  const std::string hint = hintFromMaster(
      topic, [](const std::string& type) { return type == kType; }, kType);
  throw base::InputError({"ros:" + topic,
                          0,
                          {},
                          {},
                          std::string("gives no ") + kType + (hint.empty() ? "" : ": " + hint),
                          "Start the cameras first, or give the folder of a calibration"});
}

}  // namespace

vision::StereoRig receiveRig(const std::string& left_image, const std::string& right_image,
                             std::chrono::milliseconds patience) {
  const auto topicOf = [](const std::string& image) {
    return image.substr(0, image.rfind('/')) + "/camera_info";
  };
  if (!topicsAtMaster(masterUri(), kAnswer)) refuseWithoutMaster();  // else each image would be waited for
  const std::array topics = {topicOf(left_image), topicOf(right_image)};
  std::array<std::string, 2> texts;
  for (std::size_t side = 0; side < 2; ++side) {
    TopicReader reader(topics[side], 1);
    const auto message = reader.next(patience);
    if (!message || message->type != kType) refuse(topics[side]);
    texts[side] = base::namingFile("ros:" + topics[side],
                                   [&] { return calibrationTextOf(decode<CameraInfo>(message->bytes)); });
  }
  return vision::parseStereoRig(texts[0], texts[1]);
}

}  // namespace capstan::ros1
