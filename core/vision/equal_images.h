#pragma once

#include <cstring>
#include <opencv2/core/mat.hpp>

namespace capstan::vision {

/// Whether two images have the same size, type and bytes, as a camera that repeats an image gives them. False
/// for empty images and for views into larger ones.
inline bool areEqual(const cv::Mat& a, const cv::Mat& b) {
  return !a.empty() && a.size() == b.size() && a.type() == b.type() && a.isContinuous() && b.isContinuous() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

}  // namespace capstan::vision
