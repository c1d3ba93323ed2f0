#pragma once

#include <opencv2/core/mat.hpp>

namespace capstan::vision {

/// Paints an opaque, dark, textured hand-like shape that moves slowly with t [s] over all of `bgr` (8UC3).
/// The same t and side (camera) always give the same bytes. No allocation.
void coverImage(cv::Mat& bgr, double t, int side);

}  // namespace capstan::vision
