#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "core/vision/bit_image.h"
#include "core/vision/blob.h"
#include "core/vision/circle_fit.h"
#include "core/vision/hsv_threshold.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Finds the coloured marker in the images of one camera as in the UKF paper's section II-B: HSV threshold →
/// 5×5 median → 3×3 erosion → 3×3 dilation → contour → centroid and fitted circle. The mask equals that of
/// OpenCV's cvtColor, inRange, medianBlur, erode, dilate (default borders) bit for bit; the centroid is the
/// centre of a circle fitted to sub-pixel edges.
///
/// Use one detector per thread. No allocation after construction.
class MarkerDetector {
 public:
  /// Searches regions of at most max_width × max_height [px]; a larger one gives kWrongImage.
  MarkerDetector(const MarkerOptions& options, int max_width, int max_height);

  /// Searches the whole frame (8-bit BGR).
  MarkerDetection detect(const cv::Mat& bgr);
  /// Searches `roi` (clipped to the frame). When the border of the region cuts the circle, the fit also uses
  /// pixels of the frame outside the region.
  MarkerDetection detect(const cv::Mat& bgr, const cv::Rect& roi);

  /// Mask of the last searched region after the dilation, 0 or 255, for display and tests (allocates).
  cv::Mat mask() const;
  const MarkerOptions& options() const { return options_; }

 private:
  MarkerDetection search(const cv::Mat& bgr, const cv::Rect& roi);
  void fillShape(const cv::Mat& bgr, const cv::Rect& roi, const Blob& blob, MarkerDetection& found);

  MarkerOptions options_;
  int max_width_, max_height_;
  HsvThreshold threshold_;
  BitImage raw_, median_, eroded_, cleaned_;
  RowSpan rows_;  ///< rows of cleaned_ with set pixels
  MedianScratch median_scratch_;
  BlobFinder blobs_;
  EdgeSampler edges_;
};

/// Square region of interest around a predicted pixel, moved (not shrunk) into a frame of `size`. Empty when
/// the whole square is outside the frame.
cv::Rect roiAround(const Eigen::Vector2d& pixel, const MarkerOptions& options, const cv::Size& size);

}  // namespace capstan::vision
