#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

/// Focus and exposure of an image, as numbers.
namespace capstan::vision {

inline constexpr int kHistogramBins = 64;  ///< of 4 levels each

/// Brightness of pixels: value of HSV, the largest of the three channels, 0…255.
struct Exposure {
  std::array<double, kHistogramBins> histogram{};  ///< share of the pixels in each bin
  double clipped = 0.0;                            ///< share of the pixels with a channel of kClipped or more
  double median = 0.0;                             ///< of the value
  double bright = 0.0;                             ///< 95 % quantile of the value
};

/// Level from which a channel counts as clipped. Compression and noise leave some levels below 255.
inline constexpr int kClipped = 250;

/// Exposure of the 8-bit BGR pixels inside the circle, or of all pixels without a circle (radius 0).
struct CircleArea {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< [px]
};
Exposure exposureOf(const cv::Mat& bgr, const CircleArea& area = {});

/// Blur of the sharpest edges of an 8-bit BGR image: standard deviation of the Gaussian by which an ideal
/// edge is as wide [px]; NaN where there are too few edges. From the gradients of the image smoothed by 1 and
/// by 2 px, whose ratio does not depend on the contrast (Zhuo & Sim, Defocus map estimation, 2011). Median
/// over the strongest quarter of the edges. Motion blurs edges, too.
double edgeBlur(const cv::Mat& bgr);

/// Largest blur that counts as in focus [px]: half of the reach of the marker's edge search (4 px). The ends
/// of a search ray then see marker and background to 2.3 % (two standard deviations), as the half-way level
/// of an edge assumes.
inline constexpr double kLargestBlur = 2.0;

}  // namespace capstan::vision
