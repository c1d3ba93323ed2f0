#include "core/vision/hsv_threshold.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/check.h"
#include "core/vision/hsv_kernel.h"

namespace capstan::vision {

namespace {

constexpr int kShift = 12;  // fixed point of OpenCV's 8-bit HSV
constexpr HsvThreshold::Sector kWholeSector{true, false, -31, 31};

/// Part of the hue range [low, high], low <= high, in the sector around `centre` (0, 60 or 120).
HsvThreshold::Sector sectorOf(int low, int high, int centre) {
  if (centre > 0) {
    const int from = std::max(low - centre, -31), to = std::min(high - centre, 31);
    return {from <= 30 && to >= -30, false, from, to};
  }
  const bool above = low <= 30, below = high >= 150;  // hue 0 divides the red sector
  if (above && below) {
    if (low == 0 && high == 179) return kWholeSector;
    return {true, true, high - 179, low - 1};
  }
  if (above) return {true, false, low, std::min(high, 31)};
  if (below) return {true, false, std::max(low - 180, -31), high - 180};
  return {};
}

HsvThreshold::Sector wrappedSectorOf(int low, int high, int centre) {
  if (low <= high) return sectorOf(low, high, centre);
  if (high + 1 > low - 1) return kWholeSector;
  HsvThreshold::Sector gap = sectorOf(high + 1, low - 1, centre);
  if (!gap.active) return kWholeSector;
  gap.inverted = !gap.inverted;
  return gap;
}

/// Prefetches a row. Always inline: the compiler drops calls of a function that only prefetches, as pure.
__attribute__((always_inline)) inline void prefetchRow(const cv::Mat& bgr, int y) {
  constexpr int kCacheLine = 64;
  const int bytes = 3 * bgr.cols;
  for (int at = 0; at < bytes + kCacheLine; at += kCacheLine)
    __builtin_prefetch(bgr.ptr<std::uint8_t>(y) + std::min(at, bytes - 1));
}

}  // namespace

HsvThreshold::HsvThreshold(const MarkerOptions& options)
    : hue_low_(options.hue_low),
      hue_high_(options.hue_high),
      saturation_low_(options.saturation_low),
      value_low_(options.value_low) {
  saturation_divisor_[0] = hue_divisor_[0] = 0;
  for (int i = 1; i < 256; ++i) {
    saturation_divisor_[i] = static_cast<std::int32_t>(std::lrint((255 << kShift) / (1.0 * i)));
    hue_divisor_[i] = static_cast<std::int32_t>(std::lrint((180 << kShift) / (6.0 * i)));
  }
  for (int k = 0; k < 3; ++k) sectors_[k] = wrappedSectorOf(hue_low_, hue_high_, 60 * k);
}

bool HsvThreshold::contains(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
  const int v = std::max({b, g, r});
  if (v < value_low_) return false;
  const int diff = v - std::min({b, g, r});
  if ((diff * saturation_divisor_[v] + (1 << (kShift - 1))) >> kShift < saturation_low_) return false;
  int h = v == r ? g - b : v == g ? b - r + 2 * diff : r - g + 4 * diff;
  h = (h * hue_divisor_[diff] + (1 << (kShift - 1))) >> kShift;
  if (h < 0) h += 180;
  return hue_low_ <= hue_high_ ? h >= hue_low_ && h <= hue_high_ : h >= hue_low_ || h <= hue_high_;
}

std::uint64_t HsvKernel::portableRow(const HsvThreshold& test, const std::uint8_t* bgr, int width,
                                     std::uint64_t* bits) {
  std::uint64_t any = 0;
  for (int x = 0; x < width; x += 64) {
    const int count = std::min(64, width - x);
    std::uint64_t word = 0;
    for (int i = 0; i < count; ++i, bgr += 3)
      word |= std::uint64_t{test.contains(bgr[0], bgr[1], bgr[2])} << i;
    bits[x >> 6] = word;
    any |= word;
  }
  return any;
}

RowSpan HsvKernel::rows(const HsvThreshold& test, const cv::Mat& bgr, Row* row, BitImage& result) {
  CAPSTAN_CHECK(bgr.type() == CV_8UC3);
  result.resize(bgr.cols, bgr.rows);
  RowSpan span;
  constexpr int kAhead = 12;  // rows of a region are far apart, so the processor cannot predict them
  const bool scattered = !bgr.isContinuous();
  for (int y = 0; y < bgr.rows; ++y) {
    if (scattered && y + kAhead < bgr.rows) prefetchRow(bgr, y + kAhead);
    if (row(test, bgr.ptr<std::uint8_t>(y), bgr.cols, result.row(y)) == 0) continue;
    if (span.empty()) span.first = y;
    span.last = y;
  }
  return span;
}

RowSpan HsvThreshold::apply(const cv::Mat& bgr, BitImage& result) const {
  static const bool wide = HsvKernel::hasAvx2();
  return HsvKernel::rows(*this, bgr, wide ? HsvKernel::avx2Row : HsvKernel::portableRow, result);
}

RowSpan HsvThreshold::applyPortable(const cv::Mat& bgr, BitImage& result) const {
  return HsvKernel::rows(*this, bgr, HsvKernel::portableRow, result);
}

}  // namespace capstan::vision
