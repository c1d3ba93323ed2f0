#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/vision/bit_image.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Is a BGR pixel inside the marker's HSV range? Fuses cv::cvtColor(COLOR_BGR2HSV) on 8 bits and cv::inRange,
/// and agrees with them for every one of the 2^24 colours. Hue wraps when hue_low > hue_high.
class HsvThreshold {
 public:
  explicit HsvThreshold(const MarkerOptions& options);

  /// The test for one pixel, by OpenCV's own integer arithmetic.
  bool contains(std::uint8_t b, std::uint8_t g, std::uint8_t r) const;
  /// Sets `result` (resized to the image) to the mask of an 8-bit BGR image. Returns the span of rows with
  /// set pixels.
  RowSpan apply(const cv::Mat& bgr, BitImage& result) const;
  /// The same without vector instructions, whatever the processor.
  RowSpan applyPortable(const cv::Mat& bgr, BitImage& result) const;

  /// Hue range inside one sector (maximum is red, green or blue), in units of hue from the sector's centre.
  struct Sector {
    bool active = false;  ///< some hue of the sector is in range
    bool inverted = false;
    int low = 0, high = 0;  ///< in range: (low <= hue − centre <= high) != inverted
  };

 private:
  int hue_low_, hue_high_, saturation_low_, value_low_;
  std::array<std::int32_t, 256> saturation_divisor_;  ///< round(255 · 2^12 / v), as in OpenCV's RGB2HSV_b
  std::array<std::int32_t, 256> hue_divisor_;         ///< round(180 · 2^12 / 6 diff)
  std::array<Sector, 3> sectors_;                     ///< red, green, blue

  friend struct HsvKernel;
};

}  // namespace capstan::vision
