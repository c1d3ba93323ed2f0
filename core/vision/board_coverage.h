#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/vision/calibration.h"

namespace capstan::vision {

/// Where one image shows the board, as ROS's cameracalibrator measures it; all numbers from 0 to 1.
struct ViewShape {
  double x = 0.0, y = 0.0;  ///< middle of the board in the image, 0 left or top
  double size = 0.0;        ///< square root of the board's share of the image
  double skew = 0.0;        ///< 0: corners are right angles; 1: they differ by 45° or more, by a tilt

  /// Sum of the absolute differences.
  double distanceTo(const ViewShape& other) const;
};

/// Shape of a view with the board's corners `points` [m] at `pixels`, in an image of `size`. At least four
/// corners.
ViewShape shapeOf(const std::vector<cv::Point3f>& points, const std::vector<cv::Point2f>& pixels,
                  const cv::Size& size);

/// Share of the range that a good calibration needs (ROS's cameracalibrator: 0.7 of the width, 0.7 of the
/// height, 0.4 of sizes, 0.5 of skews), by what the views cover.
BoardCoverage coverageOf(const std::vector<ViewShape>& views);

}  // namespace capstan::vision
