#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "core/vision/bit_image.h"
#include "core/vision/blob.h"
#include "core/vision/circle_fit.h"
#include "core/vision/hsv_threshold.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Finds the coloured marker of one camera as the UKF paper's section II-B does: HSV threshold → 5×5 median →
/// 3×3 erosion → 3×3 dilation → contour → centroid and fitted circle. The mask equals that of OpenCV's
/// cvtColor, inRange, medianBlur, erode, dilate (default borders) bit for bit; the centroid is that of a
/// circle fitted to sub-pixel edges.
///
/// One detector belongs to one thread. Nothing is allocated after construction.
class MarkerDetector {
 public:
  /// Images up to max_width × max_height [px]; what is searched may not be larger (kWrongImage).
  MarkerDetector(const MarkerOptions& options, int max_width, int max_height);

  /// Searches the whole frame (8-bit BGR).
  MarkerDetection detect(const cv::Mat& bgr);
  /// Searches `roi` (clipped to the frame). A circle that the region cuts is followed beyond it into the
  /// frame.
  MarkerDetection detect(const cv::Mat& bgr, const cv::Rect& roi);

  /// The last searched region's mask after the morphology, 0 or 255: for views and tests (allocates).
  cv::Mat mask() const;
  const MarkerOptions& options() const { return options_; }

 private:
  MarkerDetection search(const cv::Mat& bgr, const cv::Rect& roi);
  void fillShape(const cv::Mat& bgr, const cv::Rect& roi, const Blob& blob, MarkerDetection& found);

  MarkerOptions options_;
  int max_width_, max_height_;
  HsvThreshold threshold_;
  BitImage raw_, median_, eroded_, cleaned_;
  RowSpan rows_;  ///< of cleaned_
  MedianScratch median_scratch_;
  BlobFinder blobs_;
  EdgeSampler edges_;
};

/// The square region of interest around a predicted pixel, moved (not shrunk) to lie inside a frame of
/// `size`. Empty when the whole square would lie outside the frame.
cv::Rect roiAround(const Eigen::Vector2d& pixel, const MarkerOptions& options, const cv::Size& size);

}  // namespace capstan::vision
