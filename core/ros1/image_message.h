#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <string>

#include "core/ros1/message_data.h"
#include "core/vision/camera.h"

namespace capstan::ros1 {

/// 8-bit BGR image of a message. Encodings: bgr8, rgb8, bgra8, rgba8, mono8, 8UC1, 8UC3 and the four Bayer
/// patterns of 8 bits. Throws base::InputError for another encoding and for a size that does not fit the
/// data.
cv::Mat imageOf(const Image& message);
/// The same of a JPEG or PNG image. Throws base::InputError for data that are no image.
cv::Mat imageOf(const CompressedImage& message);
/// Message of an 8-bit BGR or grey image.
Image messageOf(const cv::Mat& image, MessageHeader header);

/// Text of a calibration in ROS camera_info YAML (vision/camera.h). Throws base::InputError for a camera that
/// was never calibrated.
std::string calibrationTextOf(const CameraInfo& message);
/// Messages of both cameras, left and right, in the frame of `header`.
std::array<CameraInfo, 2> messagesOf(const vision::StereoRig& rig);

}  // namespace capstan::ros1
