#include "core/vision/picture_markers.h"

#include <algorithm>

namespace capstan::vision {

MarkerDetector& PictureMarkers::detectorFor(const cv::Mat& picture) {
  if (!detector_ || picture.cols > largest_.width || picture.rows > largest_.height) {
    largest_ = {std::max(largest_.width, picture.cols), std::max(largest_.height, picture.rows)};
    detector_.emplace(options_, largest_.width, largest_.height);
  }
  return *detector_;
}

std::array<MarkerDetection, 2> PictureMarkers::inFrames(const std::array<cv::Mat, 2>& pictures) {
  return {detectorFor(pictures[0]).detect(pictures[0]), detectorFor(pictures[1]).detect(pictures[1])};
}

std::array<MarkerDetection, 2> PictureMarkers::inSequence(const std::array<cv::Mat, 2>& pictures) {
  std::array<MarkerDetection, 2> found;
  for (std::size_t side = 0; side < 2; ++side) {
    MarkerDetector& detector = detectorFor(pictures[side]);
    if (last_[side])
      found[side] = detector.detect(pictures[side], roiAround(*last_[side], options_, pictures[side].size()));
    if (!found[side].found()) found[side] = detector.detect(pictures[side]);
    last_[side].reset();
    if (found[side].found()) last_[side] = found[side].centroid;
  }
  return found;
}

}  // namespace capstan::vision
