#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/base/random.h"

namespace capstan::simulation {

/// Exposure and colour noise of a sensor. Normal noise of each colour comes from a larger picture of it,
/// drawn once and placed at another random offset in each frame; drawing it again would cost five times as
/// much.
class ImageNoise {
 public:
  /// `sigma` [grey levels]; `exposure` is the standard deviation of a frame's brightness, as a share.
  ImageNoise(int width, int height, double sigma, double exposure, std::uint64_t seed);
  void apply(cv::Mat& image);

 private:
  static constexpr int kMargin = 128;  // offsets across and down [px]
  double sigma_, exposure_;
  base::Random random_;
  cv::Mat above_, below_;  // positive and negative part of the noise, 8-bit BGR
};

}  // namespace capstan::simulation
