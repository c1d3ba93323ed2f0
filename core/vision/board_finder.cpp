#include "core/vision/board_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace capstan::vision {

namespace {

namespace aruco = cv::aruco;

constexpr int kLeastSide = 3;   // inner corners of the smallest board that is looked for
constexpr double kFlat = 0.05;  // smallest ratio of the two extents of corners that span a plane
constexpr int kCornersOfMarker = 4;

int dictionaryOf(BoardDictionary dictionary) {
  switch (dictionary) {
    case BoardDictionary::k4x4:
      return aruco::DICT_4X4_250;
    case BoardDictionary::k5x5:
      return aruco::DICT_5X5_250;
    case BoardDictionary::k6x6:
      return aruco::DICT_6X6_250;
    case BoardDictionary::kOriginal:
      return aruco::DICT_ARUCO_ORIGINAL;
    case BoardDictionary::kAprilTag36h11:
      return aruco::DICT_APRILTAG_36h11;
  }
  return aruco::DICT_4X4_250;
}

void refine(const cv::Mat& grey, int window, std::vector<cv::Point2f>& corners) {
  constexpr int kSteps = 50;
  constexpr double kSmallest = 1e-3;  // [px]
  cv::cornerSubPix(grey, corners, cv::Size(window, window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kSteps, kSmallest));
}

std::optional<BoardCorners> findChessboard(const cv::Mat& grey, const CalibrationOptions& options) {
  BoardCorners found;
  if (!cv::findChessboardCorners(grey, {options.board_columns, options.board_rows}, found.pixels,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return std::nullopt;
  refine(grey, options.corner_window, found.pixels);
  found.ids.resize(found.pixels.size());
  std::iota(found.ids.begin(), found.ids.end(), 0);
  return found;
}

}  // namespace

void refuseCalibration(const std::string& key, const std::string& value, const std::string& reason,
                       const std::string& remedy) {
  throw base::InputError({"calibration", 0, key, value, reason, remedy});
}

bool BoardPair::enough() const {
  if (points.size() < kLeastCorners) return false;
  cv::Mat centred(static_cast<int>(points.size()), 2, CV_64F);
  for (int i = 0; i < centred.rows; ++i) {
    centred.at<double>(i, 0) = points[static_cast<std::size_t>(i)].x;
    centred.at<double>(i, 1) = points[static_cast<std::size_t>(i)].y;
  }
  for (int column = 0; column < 2; ++column) centred.col(column) -= cv::mean(centred.col(column))[0];
  cv::Mat extents;
  cv::SVD::compute(centred, extents);
  return extents.at<double>(1) > kFlat * extents.at<double>(0);
}

/// Boards of markers.
class BoardFinder::Markers {
 public:
  explicit Markers(const CalibrationOptions& options)
      : dictionary_(aruco::getPredefinedDictionary(dictionaryOf(options.dictionary))) {
    const bool charuco = options.board == BoardKind::kCharuco;
    const int needed = charuco ? (options.board_columns + 1) * (options.board_rows + 1) / 2
                               : options.board_columns * options.board_rows;
    if (needed > dictionary_->bytesList.rows)
      refuseCalibration(
          "dictionary", std::string(base::nameOf(options.dictionary)),
          fmt::format("has {} markers, but the board has {}", dictionary_->bytesList.rows, needed),
          "Choose the board's own dictionary");
    const auto square = static_cast<float>(options.square_size);
    const auto marker = static_cast<float>(options.marker_size);
    if (!(marker > 0.0F && marker < square))
      refuseCalibration("marker_size", fmt::format("{}", options.marker_size),
                        fmt::format("is not between 0 and square_size, {}", options.square_size),
                        "Give the side of a marker");
    if (charuco) {
      charuco_ = aruco::CharucoBoard::create(options.board_columns + 1, options.board_rows + 1, square,
                                             marker, dictionary_);
      return;
    }
    parameters_->cornerRefinementMethod = aruco::CORNER_REFINE_CONTOUR;
    grid_ = aruco::GridBoard::create(options.board_columns, options.board_rows, marker, square - marker,
                                     dictionary_);
  }

  /// The corners as OpenCV refines them: windows of cv::cornerSubPix would reach into the markers.
  std::optional<BoardCorners> find(const cv::Mat& grey) const {
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    aruco::detectMarkers(grey, dictionary_, corners, ids, parameters_);
    BoardCorners found;
    if (ids.empty()) return std::nullopt;
    if (charuco_)
      aruco::interpolateCornersCharuco(corners, ids, grey, charuco_, found.pixels, found.ids);
    else
      takeCorners(corners, ids, found);
    if (found.pixels.empty()) return std::nullopt;
    return found;
  }

  cv::Point3f position(int id) const {
    if (charuco_) return charuco_->chessboardCorners[static_cast<std::size_t>(id)];
    return grid_->objPoints[static_cast<std::size_t>(id / kCornersOfMarker)]
                           [static_cast<std::size_t>(id % kCornersOfMarker)];
  }

 private:
  void takeCorners(const std::vector<std::vector<cv::Point2f>>& corners, const std::vector<int>& ids,
                   BoardCorners& found) const {
    std::vector<std::pair<int, std::size_t>> order;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto place = std::find(grid_->ids.begin(), grid_->ids.end(), ids[i]);
      if (place != grid_->ids.end()) order.emplace_back(static_cast<int>(place - grid_->ids.begin()), i);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [marker, i] : order)
      for (int corner = 0; corner < kCornersOfMarker; ++corner) {
        found.ids.push_back(kCornersOfMarker * marker + corner);
        found.pixels.push_back(corners[i][static_cast<std::size_t>(corner)]);
      }
  }

  cv::Ptr<aruco::Dictionary> dictionary_;
  cv::Ptr<aruco::DetectorParameters> parameters_ = aruco::DetectorParameters::create();
  cv::Ptr<aruco::CharucoBoard> charuco_;
  cv::Ptr<aruco::GridBoard> grid_;
};

BoardFinder::BoardFinder(const CalibrationOptions& options) : options_(options) {
  if (options.board != BoardKind::kChessboard) markers_ = std::make_unique<Markers>(options);
}

BoardFinder::~BoardFinder() = default;

std::optional<BoardCorners> BoardFinder::find(const cv::Mat& grey) const {
  return markers_ ? markers_->find(grey) : findChessboard(grey, options_);
}

cv::Point3f BoardFinder::position(int id) const {
  if (markers_) return markers_->position(id);
  return {static_cast<float>(id % options_.board_columns * options_.square_size),
          static_cast<float>(id / options_.board_columns * options_.square_size), 0.0F};
}

BoardPair BoardFinder::common(const BoardCorners& left, const BoardCorners& right) const {
  BoardPair pair;
  for (std::size_t i = 0, j = 0; i < left.ids.size() && j < right.ids.size();) {
    if (left.ids[i] < right.ids[j]) {
      ++i;
    } else if (right.ids[j] < left.ids[i]) {
      ++j;
    } else {
      pair.points.push_back(position(left.ids[i]));
      pair.left.push_back(left.pixels[i++]);
      pair.right.push_back(right.pixels[j++]);
    }
  }
  return pair;
}

std::optional<cv::Size> chessboardSize(const cv::Mat& grey) {
  cv::Mat corners, board;
  if (!cv::findChessboardCornersSB(
          grey, {kLeastSide, kLeastSide}, corners,
          cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_LARGER, board))
    return std::nullopt;
  return cv::Size(std::max(board.cols, board.rows), std::min(board.cols, board.rows));
}

}  // namespace capstan::vision
