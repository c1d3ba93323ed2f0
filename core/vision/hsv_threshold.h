#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/vision/bit_image.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Test whether a BGR pixel is inside the marker's HSV range. It combines cv::cvtColor(COLOR_BGR2HSV) on 8
/// bits with cv::inRange and agrees with them for all 2^24 colours. Hue wraps if hue_low > hue_high.
class HsvThreshold {
 public:
  explicit HsvThreshold(const MarkerOptions& options);

  /// Whether one pixel is inside the range, by OpenCV's integer arithmetic.
  bool contains(std::uint8_t b, std::uint8_t g, std::uint8_t r) const;
  /// Sets `result` (resized to the image) to the mask of an 8-bit BGR image. Returns the range of rows with
  /// set pixels.
  RowSpan apply(const cv::Mat& bgr, BitImage& result) const;
  /// apply() without vector instructions, on every processor.
  RowSpan applyPortable(const cv::Mat& bgr, BitImage& result) const;

  /// Hue range in one sector (red, green or blue is the largest channel), in hue units from its centre.
  struct Sector {
    bool active = false;  ///< whether any hue of the sector is in range
    bool inverted = false;
    int low = 0, high = 0;  ///< a hue is in range when (low <= hue − centre <= high) != inverted
  };

 private:
  int hue_low_, hue_high_, saturation_low_, value_low_;
  std::array<std::int32_t, 256> saturation_divisor_;  ///< round(255 · 2^12 / v), as in OpenCV's RGB2HSV_b
  std::array<std::int32_t, 256> hue_divisor_;         ///< round(180 · 2^12 / 6 diff)
  std::array<Sector, 3> sectors_;                     ///< red, green, blue

  friend struct HsvKernel;
};

}  // namespace capstan::vision
