#include "core/simulation/background.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"

namespace capstan::simulation {
namespace {

/// Smooth noise in −1…1: octaves of random grids, each half as strong as the one before.
cv::Mat octaves(int width, int height, base::Random& random) {
  cv::Mat sum(height, width, CV_32F, cv::Scalar(0.0));
  double strength = 0.5;
  for (int cells = 5; cells <= 80; cells *= 2, strength *= 0.5) {
    cv::Mat grid(cells, cells * 4 / 3, CV_32F), layer;
    for (auto value = grid.begin<float>(); value != grid.end<float>(); ++value)
      *value = static_cast<float>(random.uniform(-1.0, 1.0));
    cv::resize(grid, layer, sum.size(), 0.0, 0.0, cv::INTER_CUBIC);
    sum += strength * layer;
  }
  return sum;
}

/// Illumination of each pixel: 1 on the lit side, 1 − unevenness on the dark side, with a smooth step between
/// them along a random direction.
cv::Mat lightField(int width, int height, double unevenness, base::Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::hypot(width, height);
  cv::Mat light(height, width, CV_32F);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double s =
          ((u - 0.5 * width) * std::cos(angle) + (v - 0.5 * height) * std::sin(angle)) / across + 0.5;
      const double c = std::clamp(s, 0.0, 1.0);
      light.at<float>(v, u) = static_cast<float>(1.0 - unevenness * c * c * (3.0 - 2.0 * c));
    }
  return light;
}

void addDistractors(cv::Mat& image, const ImageTruth& appearance, base::Random& random) {
  constexpr double kMargin = 0.18, kBorder = 0.03, kMiddle = 0.3;  // positions, shares of the width
  constexpr int kFraction = 4;  // bits of a pixel in OpenCV's drawing coordinates
  const Eigen::Vector3f colour = bgrOf(appearance.marker_hue + appearance.distractor_hue, 165.0, 190.0);
  constexpr int kRings = 10;
  for (int i = 0; i < appearance.distractors; ++i) {
    const double inset = random.uniform(kBorder, kMargin) * image.cols;
    const double within = random.uniform(kMiddle, 1.0 - kMiddle) * image.cols;
    const double u = i % 3 == 0 ? inset : i % 3 == 1 ? image.cols - inset : within;
    const double v = random.uniform(0.08, 0.92) * image.rows, radius = random.uniform(5.0, 9.0);
    for (int ring = kRings; ring > 2; --ring) {  // brighter towards the middle, like a bead
      const double share = static_cast<double>(ring) / kRings;
      const float shade = static_cast<float>(1.1 - 0.5 * share);
      const Eigen::Vector3f bgr = shade * colour;
      cv::circle(image,
                 cv::Point(static_cast<int>(u * (1 << kFraction)), static_cast<int>(v * (1 << kFraction))),
                 static_cast<int>(share * radius * (1 << kFraction)), cv::Scalar(bgr[0], bgr[1], bgr[2]),
                 cv::FILLED, cv::LINE_AA, kFraction);
    }
  }
}

}  // namespace

Eigen::Vector3f bgrOf(double hue, double saturation, double value) {
  const double turn = hue * 2.0 / 60.0;
  const auto channel = [&](double offset) {
    const double k = std::fmod(std::fmod(offset + turn, 6.0) + 6.0, 6.0);
    return static_cast<float>(value -
                              value * saturation / 255.0 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(1.0), channel(3.0), channel(5.0)};
}

Background makeBackground(int image_width, int height, const ImageTruth& appearance, std::uint64_t seed,
                          int shift) {
  const int width = image_width + kSceneMargin;
  base::Random random(seed, "background");
  const cv::Mat relief = octaves(width, height, random), veins = octaves(width, height, random);
  Background made;
  made.light = lightField(width, height, appearance.unevenness, random);
  made.image.create(height, width, CV_8UC3);
  const Eigen::Vector3f flesh(105.0F, 115.0F, 175.0F), blood(-20.0F, -35.0F, -15.0F);
  const auto contrast = static_cast<float>(appearance.texture);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const float tone = 1.0F + 0.5F * contrast * relief.at<float>(v, u);
      const Eigen::Vector3f bgr = tone * flesh + contrast * std::max(0.0F, veins.at<float>(v, u)) * blood;
      for (int c = 0; c < 3; ++c) made.image.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(bgr[c]);
    }
  addDistractors(made.image, appearance, random);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      for (int c = 0; c < 3; ++c) {
        std::uint8_t& value = made.image.at<cv::Vec3b>(v, u)[c];
        value = cv::saturate_cast<std::uint8_t>(made.light.at<float>(v, u) * static_cast<float>(value));
      }
  const cv::Rect part(shift, 0, image_width, height);
  return {made.image(part).clone(), made.light(part).clone()};
}

}  // namespace capstan::simulation
