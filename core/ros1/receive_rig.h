#pragma once

#include <chrono>
#include <string>

#include "core/vision/camera.h"

namespace capstan::ros1 {

/// Calibration of two cameras from the topics camera_info beside their image topics. Waits up to `patience`
/// for each. Throws base::InputError where none comes, and for cameras that were never calibrated.
vision::StereoRig receiveRig(const std::string& left_image, const std::string& right_image,
                             std::chrono::milliseconds patience);

}  // namespace capstan::ros1
