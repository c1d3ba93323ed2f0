#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/base/random.h"

namespace capstan::simulation {

/// Exposure noise and colour noise of an image sensor. A noise image larger than a frame, normal in each
/// colour, is drawn once; each frame takes it at another random offset. Drawing new noise per frame would
/// take five times as long.
class ImageNoise {
 public:
  /// `sigma`: standard deviation of each colour [grey levels]. `exposure`: standard deviation of a frame's
  /// brightness, as a share of it.
  ImageNoise(int width, int height, double sigma, double exposure, std::uint64_t seed);
  void apply(cv::Mat& image);

 private:
  static constexpr int kMargin = 128;  // number of offsets, horizontal and vertical [px]
  double sigma_, exposure_;
  base::Random random_;
  cv::Mat above_, below_;  // positive and negative parts of the noise, 8-bit BGR
};

}  // namespace capstan::simulation
