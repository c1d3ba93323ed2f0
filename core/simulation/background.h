#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/simulation/truth.h"

namespace capstan::simulation {

/// BGR colour (0…255 per channel) of an OpenCV hue (0…179), saturation and value (0…255).
Eigen::Vector3f bgrOf(double hue, double saturation, double value);

inline constexpr int kSceneMargin = 64;  ///< width of the scene minus width of an image [px]

/// The static background of one camera's image.
struct Background {
  cv::Mat image;  ///< 8-bit BGR, light included
  cv::Mat light;  ///< illumination of each pixel as a share of full light, 32-bit float
};

/// Returns a tissue-like texture of several octaves. Uneven light comes from one side. Distractors lie near
/// the image borders, outside the region in which the tool works. `shift` (0…kSceneMargin) [px] is the offset
/// of this camera's image to the right of the left camera's image. Same seed, same bytes.
Background makeBackground(int width, int height, const ImageTruth& appearance, std::uint64_t seed, int shift);

}  // namespace capstan::simulation
