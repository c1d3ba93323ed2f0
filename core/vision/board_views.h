#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/vision/calibration.h"

namespace capstan::vision {

/// Corners in the pairs that show the whole board in both images, and the state of all pairs.
struct BoardViews {
  std::vector<CalibrationView> views;                 ///< all pairs, in input order
  std::vector<std::size_t> seen;                      ///< index into `views` of each entry of left and right
  std::vector<std::vector<cv::Point2f>> left, right;  ///< sub-pixel corners per complete pair [px]
  cv::Size size;                                      ///< size of the images [px]
};

/// Finds the board's inner corners (cv::findChessboardCorners, then cv::cornerSubPix) in every pair. The
/// first readable image sets the size. Stops early when `progress` is cancelled.
BoardViews findBoards(const CalibrationInput& input, const CalibrationOptions& options,
                      base::Progress& progress);

/// Inner corners of the board in the board's plane, row by row [m].
std::vector<cv::Point3f> boardPoints(const CalibrationOptions& options);

}  // namespace capstan::vision
