#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/random.h"

namespace capstan::testing {

/// A shaded disc with known centre in front of a textured, unevenly lit, noisy background.
struct DiscScene {
  int width = 160, height = 120;
  Eigen::Vector2d centre{80.0, 60.0};         ///< [px], pixel (0, 0) is the centre of the top-left pixel
  double radius = 11.0;                       ///< [px]; 0: no disc
  Eigen::Vector3d colour{50.0, 190.0, 60.0};  ///< B, G, R at full light
  double shading = 0.45;                      ///< share of the light that is shaded as on a sphere; 0: flat
  Eigen::Vector2d light{-0.5, -0.6};          ///< direction towards the light, in the image
  double blur = 0.8;                          ///< standard deviation of the lens blur [px]
  double noise = 2.5;                         ///< standard deviation of each channel, 8-bit levels
  bool texture = true;
};

/// Colour B, G, R of the ideal image at a point.
inline Eigen::Vector3d idealColour(const DiscScene& scene, double x, double y) {
  Eigen::Vector3d back(95.0, 100.0, 110.0);
  if (scene.texture) {
    back *= 0.75 + 0.35 * x / scene.width;
    back.array() += 12.0 * std::sin(0.31 * x + 0.7 * std::sin(0.11 * y)) * std::cos(0.23 * y);
  }
  const Eigen::Vector2d arm = (Eigen::Vector2d(x, y) - scene.centre) / std::max(scene.radius, 1e-9);
  const double squared = arm.squaredNorm();
  if (scene.radius <= 0.0 || squared > 1.0) return back;
  const Eigen::Vector3d normal(arm.x(), arm.y(), std::sqrt(1.0 - squared));
  const Eigen::Vector3d light = Eigen::Vector3d(scene.light.x(), scene.light.y(), 0.8).normalized();
  return scene.colour * (1.0 - scene.shading + scene.shading * std::max(0.0, normal.dot(light)));
}

/// Renders the scene as an 8-bit BGR image: 8 × 8 samples per pixel near the disc's edge, Gaussian blur,
/// noise, rounding.
inline cv::Mat renderDisc(const DiscScene& scene, base::Random& random) {
  const auto pixel = [&](int x, int y) {
    const double from_edge = std::abs((Eigen::Vector2d(x, y) - scene.centre).norm() - scene.radius);
    const int fold = scene.radius > 0.0 && from_edge < 1.0 ? 8 : 1;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < fold; ++j)
      for (int i = 0; i < fold; ++i)
        sum += idealColour(scene, x + (i + 0.5) / fold - 0.5, y + (j + 0.5) / fold - 0.5);
    return Eigen::Vector3d(sum / (fold * fold));
  };
  std::vector<Eigen::Vector3d> image(static_cast<std::size_t>(scene.width) * scene.height), row(image.size());
  const auto at = [&](std::vector<Eigen::Vector3d>& of, int x, int y) -> Eigen::Vector3d& {
    return of[static_cast<std::size_t>(std::clamp(y, 0, scene.height - 1)) * scene.width +
              static_cast<std::size_t>(std::clamp(x, 0, scene.width - 1))];
  };
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) at(image, x, y) = pixel(x, y);
  if (scene.blur > 0.0) {
    const int reach = static_cast<int>(std::ceil(3.5 * scene.blur));
    std::vector<double> kernel;
    double total = 0.0;
    for (int k = -reach; k <= reach; ++k)
      total += kernel.emplace_back(std::exp(-0.5 * k * k / (scene.blur * scene.blur)));
    const auto filter = [&](std::vector<Eigen::Vector3d>& from, std::vector<Eigen::Vector3d>& to, int dx,
                            int dy) {
      for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
          Eigen::Vector3d sum = Eigen::Vector3d::Zero();
          for (int k = -reach; k <= reach; ++k) sum += kernel[k + reach] * at(from, x + k * dx, y + k * dy);
          at(to, x, y) = sum / total;
        }
    };
    filter(image, row, 1, 0);
    filter(row, image, 0, 1);
  }
  cv::Mat out(scene.height, scene.width, CV_8UC3);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      for (int c = 0; c < 3; ++c)
        out.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(
            std::clamp(std::lround(at(image, x, y)[c] + random.normal(0.0, scene.noise)), 0L, 255L));
  return out;
}

}  // namespace capstan::testing
