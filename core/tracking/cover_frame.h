#pragma once

#include <array>

#include "core/tracking/sample.h"
#include "core/vision/cover_image.h"

namespace capstan::tracking {

/// Blocks views of a frame, left and right: covers a copy of the image, which others may share, and sets
/// StereoFrame::blocked.
inline void coverFrame(StereoFrame& frame, const std::array<bool, 2>& blocked) {
  cv::Mat* const images[] = {&frame.left, &frame.right};
  for (std::size_t side = 0; side < 2; ++side) {
    if (!blocked[side]) continue;
    if (!images[side]->empty()) {
      *images[side] = images[side]->clone();
      vision::coverImage(*images[side], frame.t, static_cast<int>(side));
    }
    frame.blocked[side] = true;
  }
}

}  // namespace capstan::tracking
