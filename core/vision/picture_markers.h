#pragma once

#include <array>
#include <optional>

#include "core/vision/marker_detector.h"

namespace capstan::vision {

/// Finds the marker in pairs of pictures, each pair by itself or as one of a sequence. Pictures may differ in
/// size.
class PictureMarkers {
 public:
  explicit PictureMarkers(const MarkerOptions& options) : options_(options) {}

  /// Searches both whole pictures (8-bit BGR): left, right.
  std::array<MarkerDetection, 2> inFrames(const std::array<cv::Mat, 2>& pictures);
  /// Searches, in each picture, the region of interest around the marker of the pair before, and the whole
  /// picture where that region holds no marker or there was none before.
  std::array<MarkerDetection, 2> inSequence(const std::array<cv::Mat, 2>& pictures);

 private:
  MarkerDetector& detectorFor(const cv::Mat& picture);

  MarkerOptions options_;
  std::optional<MarkerDetector> detector_;  ///< for pictures of up to `largest_`
  cv::Size largest_;
  std::array<std::optional<Eigen::Vector2d>, 2> last_;  ///< marker of the pair before [px]
};

}  // namespace capstan::vision
