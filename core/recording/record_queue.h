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

/// What waits between the recorder's data path and its writer.
namespace capstan::recording {

/// Stands in the queue for a pair of images, which waits in the ring of frames.
struct FrameMark {};

struct Record {
  std::int64_t seq = 0;
  std::chrono::steady_clock::time_point offered;
  std::variant<tracking::MotorSample, tracking::JointSample, tracking::TipSample, EstimateRow, FrameMark> row;
};

/// What other threads hand to the writer now and then.
struct Message {
  std::int64_t seq = 0;
  SessionEvent event;
  std::optional<Eigen::Isometry3d> registration;
};

/// Slots of a queue that holds `time` seconds of `rate` rows a second.
inline std::size_t slots(double rate, double time) {
  return static_cast<std::size_t>(std::ceil(rate * time)) + 2;
}

/// Memory of a pair of images, kept when a camera gave none.
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
