#include "core/vision/board_views.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/base/error.h"

namespace capstan::vision {

namespace {

namespace fs = std::filesystem;

constexpr double kRoom = 1.5;  ///< smallest spacing of undisturbed corners, in half sides of their window

bool isImage(const fs::path& path) {
  static const std::set<std::string> kKinds{".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm"};
  std::string kind = path.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return kKinds.contains(kind);
}

[[noreturn]] void refuseFolder(const fs::path& folder, const std::string& value, const std::string& reason) {
  throw base::InputError({folder.string(),
                          0,
                          {},
                          value,
                          reason,
                          "Give a folder with image pairs named left01.png, right01.png and so on"});
}

/// Whether all corners of the board were found; if so, refines them to sub-pixel accuracy.
bool findCorners(const cv::Mat& grey, const CalibrationOptions& options, std::vector<cv::Point2f>& corners) {
  const cv::Size board(options.board_columns, options.board_rows);
  if (!cv::findChessboardCorners(grey, board, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return false;
  constexpr int kSteps = 50;
  constexpr double kSmallest = 1e-3;  // [px]
  cv::cornerSubPix(grey, corners, cv::Size(options.corner_window, options.corner_window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kSteps, kSmallest));
  return true;
}

/// Smallest distance between neighbouring corners of a row or column [px].
double smallestSpacing(const std::vector<cv::Point2f>& corners, int columns) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto take = [&](std::size_t i, std::size_t j) {
    smallest = std::min(smallest, cv::norm(corners[i] - corners[j]));
  };
  const auto across = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % across != 0) take(i, i + 1);
    if (i + across < corners.size()) take(i, i + across);
  }
  return smallest;
}

}  // namespace

CalibrationInput findStereoPairs(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (isImage(entry.path())) files.push_back(entry.path());
  if (error) refuseFolder(folder, {}, "cannot be read: " + error.message());
  std::sort(files.begin(), files.end());

  CalibrationInput input;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (name.starts_with("left")) {
      const fs::path partner = folder / ("right" + name.substr(4));
      if (!std::binary_search(files.begin(), files.end(), partner))
        refuseFolder(folder, name, "has no partner " + partner.filename().string());
      input.left.push_back(file);
      input.right.push_back(partner);
    } else if (name.starts_with("right") &&
               !std::binary_search(files.begin(), files.end(), folder / ("left" + name.substr(5)))) {
      refuseFolder(folder, name, "has no partner left" + name.substr(5));
    }
  }
  if (input.left.empty()) refuseFolder(folder, {}, "holds no pair of images");
  return input;
}

std::vector<cv::Point3f> boardPoints(const CalibrationOptions& options) {
  std::vector<cv::Point3f> points;
  for (int row = 0; row < options.board_rows; ++row)
    for (int column = 0; column < options.board_columns; ++column)
      points.emplace_back(static_cast<float>(column * options.square_size),
                          static_cast<float>(row * options.square_size), 0.0F);
  return points;
}

BoardViews findBoards(const CalibrationInput& input, const CalibrationOptions& options,
                      base::Progress& progress) {
  BoardViews found;
  const std::size_t pairs = input.left.size();
  for (std::size_t i = 0; i < pairs && !progress.cancelled(); ++i) {
    CalibrationView view;
    view.left = input.left[i].filename().string();
    view.right = input.right[i].filename().string();
    progress.report(0.6 * static_cast<double>(i) / static_cast<double>(pairs),
                    "finding the board in " + view.left);
    const cv::Mat left = cv::imread(input.left[i].string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat right = cv::imread(input.right[i].string(), cv::IMREAD_GRAYSCALE);
    if (found.size.empty()) found.size = !left.empty() ? left.size() : right.size();
    if (left.empty()) {
      view.fault = ViewFault::kLeftUnreadable;
    } else if (right.empty()) {
      view.fault = ViewFault::kRightUnreadable;
    } else if (left.size() != found.size || right.size() != found.size) {
      view.fault = ViewFault::kWrongSize;
    } else {
      std::vector<cv::Point2f> left_corners, right_corners;
      const bool in_left = findCorners(left, options, left_corners);
      const bool in_right = findCorners(right, options, right_corners);
      if (in_left && in_right) {
        view.smallest_spacing = std::min(smallestSpacing(left_corners, options.board_columns),
                                         smallestSpacing(right_corners, options.board_columns));
        view.crowded = view.smallest_spacing < kRoom * options.corner_window;
        found.seen.push_back(i);
        found.left.push_back(std::move(left_corners));
        found.right.push_back(std::move(right_corners));
      } else {
        view.fault = in_right  ? ViewFault::kBoardNotInLeft
                     : in_left ? ViewFault::kBoardNotInRight
                               : ViewFault::kBoardInNeither;
      }
    }
    found.views.push_back(std::move(view));
  }
  return found;
}

}  // namespace capstan::vision
