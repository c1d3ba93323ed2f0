#pragma once

#include <cstdint>

#include "core/vision/hsv_threshold.h"

namespace capstan::vision {

/// Implementations of HsvThreshold for one row of an image. A row function writes ceil(width / 64) words and
/// returns their bitwise OR.
struct HsvKernel {
  using Row = std::uint64_t(const HsvThreshold&, const std::uint8_t* bgr, int width, std::uint64_t* bits);

  static bool hasAvx2();
  static Row portableRow;
  static Row avx2Row;
  static RowSpan rows(const HsvThreshold& test, const cv::Mat& bgr, Row* row, BitImage& result);
};

}  // namespace capstan::vision
