#include "core/vision/image_correction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <opencv2/core.hpp>

#include <utility>
#include <vector>

namespace capstan::vision {
namespace {

void reverse(cv::Mat& image, bool columns, bool rows) {
  if (image.empty() || (!columns && !rows)) return;
  cv::Mat reversed;
  cv::flip(image, reversed, columns && rows ? -1 : columns ? 1 : 0);
  image = reversed;
}

std::string wordsOf(const char* what, const std::array<bool, 2>& sides) {
  if (sides[0] && sides[1]) return fmt::format("both images {}", what);
  return fmt::format("{} image {}", sides[0] ? "left" : "right", what);
}

}  // namespace

void ImageCorrection::apply(cv::Mat& left, cv::Mat& right) const {
  if (exchange) cv::swap(left, right);
  reverse(left, mirror[0], flip[0]);
  reverse(right, mirror[1], flip[1]);
}

std::array<Eigen::Vector2d, 2> ImageCorrection::apply(const Eigen::Vector2d& left,
                                                      const Eigen::Vector2d& right, int width,
                                                      int height) const {
  std::array<Eigen::Vector2d, 2> pixels = {left, right};
  if (exchange) std::swap(pixels[0], pixels[1]);
  for (std::size_t side = 0; side < 2; ++side) {
    if (mirror[side]) pixels[side].x() = width - 1 - pixels[side].x();
    if (flip[side]) pixels[side].y() = height - 1 - pixels[side].y();
  }
  return pixels;
}

ImageCorrection ImageCorrection::then(const ImageCorrection& next) const {
  ImageCorrection both = next;
  both.exchange = exchange != next.exchange;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t from = next.exchange ? 1 - side : side;
    both.mirror[side] = mirror[from] != next.mirror[side];
    both.flip[side] = flip[from] != next.flip[side];
  }
  return both;
}

std::string ImageCorrection::words() const {
  std::vector<std::string> parts;
  if (exchange) parts.push_back("cameras exchanged");
  if (mirror[0] || mirror[1]) parts.push_back(wordsOf("mirrored", mirror));
  if (flip[0] || flip[1]) parts.push_back(wordsOf("upside down", flip));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace capstan::vision
