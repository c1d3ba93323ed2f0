#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "core/vision/calibration.h"

namespace capstan::vision {

/// Finds out, from the first images, whether they show a chessboard of another size than expected. A search
/// for a board that is not there takes OpenCV seconds; this one takes a tenth of a second per image.
class BoardSizeVotes {
 public:
  explicit BoardSizeVotes(const CalibrationOptions& options) : options_(options) {}

  /// False after enough images, and for boards of markers.
  bool undecided() const { return options_.board == BoardKind::kChessboard && images_seen_ < kImages; }
  /// Takes an 8-bit grey image; an empty one does not count.
  void observe(const cv::Mat& grey);
  /// Size of the board that most images show, columns × rows of inner corners, where it is not the expected
  /// one; none: no clear majority of at least two.
  std::optional<cv::Size> other() const;
  /// The expected board may be in the images: as itself, or as a part of a larger one.
  bool canHold() const;

 private:
  static constexpr int kImages = 8;
  cv::Size expected() const;

  CalibrationOptions options_;
  std::map<std::pair<int, int>, int> votes_;
  int images_seen_ = 0;
};

}  // namespace capstan::vision
