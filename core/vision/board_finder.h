#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/vision/calibration.h"

namespace capstan::vision {

/// Corners of a board in one image, by number, in rising order. A chessboard has all of them.
struct BoardCorners {
  std::vector<int> ids;
  std::vector<cv::Point2f> pixels;  ///< sub-pixel positions [px]
};

/// Corners that both cameras see in a pair of images.
struct BoardPair {
  std::vector<cv::Point3f> points;       ///< in the board's plane [m]
  std::vector<cv::Point2f> left, right;  ///< [px]
  bool enough() const;                   ///< at least kLeastCorners that do not lie on one line
  static constexpr std::size_t kLeastCorners = 8;
};

/// Finds the corners of one kind of board in images: of a chessboard, all inner corners
/// (cv::findChessboardCorners); of a ChArUco board, its inner corners, also of a board seen in part; of an
/// ArUco grid, the corners of its markers. All are refined to sub-pixel accuracy: by cv::cornerSubPix, those
/// of an ArUco grid by lines along the markers' sides.
class BoardFinder {
 public:
  /// Throws base::InputError for a board that does not exist: more markers than the dictionary has, or a
  /// marker larger than its square.
  explicit BoardFinder(const CalibrationOptions& options);
  ~BoardFinder();

  /// Corners of the board in an 8-bit grey image; none: the board was not found.
  std::optional<BoardCorners> find(const cv::Mat& grey) const;
  /// Position of a corner in the board's plane [m].
  cv::Point3f position(int id) const;
  BoardPair common(const BoardCorners& left, const BoardCorners& right) const;

 private:
  class Markers;
  CalibrationOptions options_;
  std::unique_ptr<Markers> markers_;  ///< null: a chessboard
};

/// Size of the chessboard that an image shows, by a search for the largest board, as columns × rows of inner
/// corners with columns >= rows; none: the image shows no chessboard of 3 × 3 inner corners or more.
std::optional<cv::Size> chessboardSize(const cv::Mat& grey);

/// Throws base::InputError about an option or the images of a calibration.
[[noreturn]] void refuseCalibration(const std::string& key, const std::string& value,
                                    const std::string& reason, const std::string& remedy);

}  // namespace capstan::vision
