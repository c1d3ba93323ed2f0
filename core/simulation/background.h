#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/simulation/truth.h"

namespace capstan::simulation {

/// BGR of an OpenCV hue (0…179), saturation and value (0…255).
Eigen::Vector3f bgrOf(double hue, double saturation, double value);

inline constexpr int kSceneMargin = 64;  ///< the scene is this much wider than a picture [px]

/// The static background of one camera's image.
struct Background {
  cv::Mat image;  ///< 8-bit BGR, light included
  cv::Mat light;  ///< share of full light that reaches each pixel, 32-bit float
};

/// Tissue-like texture of several octaves, lit from one side when the light is uneven, with the distractors
/// at the left and right margins, outside the region in which the tool works. The picture begins `shift` [px]
/// right of the left camera's, 0…kSceneMargin. Same seed, same bytes.
Background makeBackground(int width, int height, const ImageTruth& appearance, std::uint64_t seed, int shift);

}  // namespace capstan::simulation
