#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/vision/board_coverage.h"
#include "core/vision/board_size_votes.h"
#include "core/vision/board_views.h"

namespace capstan::vision {

/// Views of a board that are taken from a running stereo camera for its calibration. A view is taken when the
/// board stands still and is seen at another place, size or tilt than in every earlier view (the rule of
/// ROS's cameracalibrator).
class CalibrationViews {
 public:
  /// Smallest distance of the shapes of two views, and the largest motion of the board between two pairs of
  /// images, as a share of the image's diagonal.
  static constexpr double kApart = 0.2, kStill = 0.004;

  enum class Verdict { kTaken, kNotSeen, kTooFewCorners, kMoving, kSimilar, kWrongSize };
  struct Observation {
    Verdict verdict = Verdict::kNotSeen;
    std::optional<BoardCorners> left, right;  ///< what was found, for overlays
  };

  /// Throws base::InputError as BoardFinder does.
  explicit CalibrationViews(const CalibrationOptions& options);

  const CalibrationOptions& options() const { return options_; }
  /// Looks for the board in a pair of 8-bit images, grey or BGR, of time t [s], and takes the view if it is
  /// new.
  Observation observe(const cv::Mat& left, const cv::Mat& right, double t);
  /// Adds pairs of image files without these rules; a chessboard of another size than expected is named.
  void addFiles(const CalibrationInput& input, base::Progress& progress);

  /// All views; those of files that cannot be used, too.
  const std::vector<CalibrationView>& views() const { return boards_.views; }
  bool usable(std::size_t view) const;
  /// Excludes a view from the calibration, or includes it again.
  void exclude(std::size_t view, bool out);
  std::size_t used() const { return chosen().seen.size(); }
  /// Size of the chessboard that the images show instead of the expected one; none: not known.
  std::optional<cv::Size> otherBoard() const { return other_ ? other_ : votes_.other(); }
  BoardCoverage coverage(int side) const;  ///< 0 left, 1 right
  cv::Size imageSize() const { return boards_.size; }
  /// Corners of every used view, for a picture of the covered area [px].
  std::vector<std::vector<cv::Point2f>> corners(int side) const;

  /// Calibrates with the chosen views. Throws base::InputError for fewer than three.
  CalibrationReport calibrate(base::Progress& progress) const;
  /// Writes the pairs of images taken from the camera as leftNN.png and rightNN.png. Throws base::InputError.
  void saveImages(const std::filesystem::path& folder) const;

 private:
  BoardViews chosen() const;
  bool still(const BoardPair& pair, double t);

  CalibrationOptions options_;
  std::shared_ptr<const BoardFinder> finder_;
  BoardViews boards_;
  std::vector<std::vector<ViewShape>> shapes_{2};
  std::vector<std::array<cv::Mat, 2>> images_;  ///< by view; empty for files
  std::optional<cv::Size> other_;               ///< in files
  BoardSizeVotes votes_;                        ///< in images of the camera
  std::vector<cv::Point2f> last_;               ///< corners of the pair before
  double last_t_ = 0.0;
};

/// Why a view was not taken, and what to do; empty for kTaken.
std::string wordsOf(CalibrationViews::Verdict verdict);

}  // namespace capstan::vision
