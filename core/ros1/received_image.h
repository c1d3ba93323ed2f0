#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/ros1/ros_topics.h"

namespace capstan::ros1 {

/// Image of a topic.
struct StampedImage {
  std::int64_t stamp = 0;  ///< [ns]; 0: none
  cv::Mat image;           ///< 8-bit BGR
};

/// Image of a message of type sensor_msgs/Image or CompressedImage. Throws base::InputError for another type,
/// for damaged bytes, and as imageOf() of image_message.h.
StampedImage imageOf(const TopicMessage& message);

}  // namespace capstan::ros1
