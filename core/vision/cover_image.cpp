#include "core/vision/cover_image.h"

#include <cmath>
#include <cstdint>

#include "core/base/check.h"

namespace capstan::vision {
namespace {

/// Pseudo-random bits of a point of the fabric: a hash (finaliser of MurmurHash3), without a state.
std::uint32_t mixed(std::uint32_t x, std::uint32_t y) {
  std::uint32_t h = x * 0x9e3779b1U ^ y * 0x85ebca77U;
  h = (h ^ (h >> 16)) * 0x85ebca6bU;
  h = (h ^ (h >> 13)) * 0xc2b2ae35U;
  return h ^ (h >> 16);
}

/// Dark glove: folds across the image and a grain of eight grey levels, in a warm tone (more red than blue).
void paintRow(std::uint8_t* pixel, int width, std::uint32_t x0, std::uint32_t y) {
  for (int i = 0; i < width; ++i, pixel += 3) {
    const std::uint32_t x = x0 + static_cast<std::uint32_t>(i);
    const std::uint32_t phase = (x * 3U + y * 5U) & 127U;
    const std::uint32_t fold = (phase < 64U ? phase : 127U - phase) / 4U;
    const std::uint32_t grain = mixed(x, y) & 7U;
    const auto shade = static_cast<std::uint8_t>(18U + fold + grain);
    pixel[0] = shade;
    pixel[1] = static_cast<std::uint8_t>(shade + 3U);
    pixel[2] = static_cast<std::uint8_t>(shade + 8U);
  }
}

}  // namespace

void coverImage(cv::Mat& bgr, double t, int side) {
  CAPSTAN_CHECK(bgr.type() == CV_8UC3);
  // The hand moves by a few pixels per second. Each camera shows a different part of it.
  const double sway = 24.0 * std::sin(1.7 * t + side);
  const auto x0 = static_cast<std::uint32_t>(4096 + side * 977 + static_cast<int>(std::lround(sway)));
  const auto y0 = static_cast<std::uint32_t>(4096 + static_cast<int>(std::lround(16.0 * std::cos(1.1 * t))));
  for (int row = 0; row < bgr.rows; ++row)
    paintRow(bgr.ptr(row), bgr.cols, x0, y0 + static_cast<std::uint32_t>(row));
}

}  // namespace capstan::vision
