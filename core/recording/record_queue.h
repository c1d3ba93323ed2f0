#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <variant>

#include "core/recording/session_file.h"
#include "core/tracking/sample.h"

/// Queue elements between the recorder's data path and its writer.
namespace capstan::recording {

/// Placeholder in the queue for a pair of images that waits in the ring of frames.
struct FrameMark {};

struct Record {
  std::int64_t seq = 0;
  std::chrono::steady_clock::time_point offered;
  std::variant<tracking::MotorSample, tracking::JointSample, tracking::TipSample, EstimateRow, FrameMark> row;
};

/// Infrequent message from other threads to the writer.
struct Message {
  std::int64_t seq = 0;
  SessionEvent event;
  std::optional<Eigen::Isometry3d> registration;
  std::optional<std::string> marker;  ///< marker options as YAML
};

/// Number of slots of a queue for `time` seconds at `rate` rows per second.
inline std::size_t slots(double rate, double time) {
  return static_cast<std::size_t>(std::ceil(rate * time)) + 2;
}

/// Memory of a pair of images; it is kept when a camera gives no image.
struct FrameSlot {
  double t = 0.0, t_arrival = 0.0;
  std::array<cv::Mat, 2> image;
  std::array<bool, 2> present{};

  void take(const tracking::StereoFrame& frame) {
    t = frame.t;
    t_arrival = frame.t_arrival;
    const cv::Mat* const from[] = {&frame.left, &frame.right};
    for (std::size_t side = 0; side < 2; ++side) {
      present[side] = !from[side]->empty();
      if (present[side]) from[side]->copyTo(image[side]);
    }
  }
  tracking::StereoFrame view() const {
    return {t, t_arrival, present[0] ? image[0] : cv::Mat(), present[1] ? image[1] : cv::Mat()};
  }
};

}  // namespace capstan::recording
