#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/vision/board_finder.h"
#include "core/vision/calibration.h"

namespace capstan::vision {

/// Corners in the pairs that show the board in both images, and the state of all pairs.
struct BoardViews {
  std::vector<CalibrationView> views;  ///< all pairs, in input order
  std::vector<std::size_t> seen;       ///< index into `views` of each entry of pairs
  std::vector<BoardPair> pairs;        ///< corners per complete pair
  cv::Size size;                       ///< size of the images [px]

  /// The same views without the pairs for which `out(view)` holds.
  template <class Out>
  BoardViews without(Out out) const {
    BoardViews kept{views, {}, {}, size};
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (out(views[seen[i]])) continue;
      kept.seen.push_back(seen[i]);
      kept.pairs.push_back(pairs[i]);
    }
    return kept;
  }
};

/// Adds the corners that were found in a pair of images to `views`.
void addCorners(BoardPair pair, const CalibrationOptions& options, CalibrationView view, BoardViews& views);

/// Adds a pair of 8-bit grey images to `views`. The first one sets the size. `search`: false where the board
/// is known not to be there.
void addPair(const cv::Mat& left, const cv::Mat& right, const BoardFinder& finder,
             const CalibrationOptions& options, CalibrationView view, BoardViews& views, bool search = true);

/// Finds the board in every pair of files. The first readable image sets the size. Stops early when
/// `progress` is cancelled. `other`, if not null, gets the size of the chessboard that most of the first
/// images show, where it is not the expected one: a larger board holds the expected one as a part.
BoardViews findBoards(const CalibrationInput& input, const CalibrationOptions& options,
                      base::Progress& progress, std::optional<cv::Size>* other = nullptr);

/// Fits both cameras and the transform between them. `other`: size of the chessboard that was seen instead of
/// the expected one, for the error. Throws base::InputError when fewer than three pairs remain.
CalibrationReport calibrateBoards(BoardViews boards, const CalibrationOptions& options,
                                  base::Progress& progress, const std::optional<cv::Size>& other = {});

}  // namespace capstan::vision
