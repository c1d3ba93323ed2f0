#pragma once

#include <opencv2/core/mat.hpp>

namespace capstan::vision {

/// Paints an opaque, dark, textured hand-like shape over all of `bgr` (8UC3), moving slowly with t.
/// Deterministic in (t, side): the same bytes each time. No allocation.
void coverImage(cv::Mat& bgr, double t, int side);

}  // namespace capstan::vision
