#include "core/vision/board_views.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "core/base/error.h"
#include "core/vision/board_size_votes.h"

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

/// Smallest distance between corners that are neighbours on the board [px].
double smallestSpacing(const std::vector<cv::Point3f>& points, const std::vector<cv::Point2f>& pixels) {
  double step = std::numeric_limits<double>::infinity();  // between neighbours on the board
  for (std::size_t i = 1; i < points.size(); ++i) step = std::min(step, cv::norm(points[i] - points[0]));
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      if (cv::norm(points[i] - points[j]) < 1.01 * step)
        smallest = std::min(smallest, cv::norm(pixels[i] - pixels[j]));
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

void addCorners(BoardPair pair, const CalibrationOptions& options, CalibrationView view, BoardViews& views) {
  view.smallest_spacing =
      std::min(smallestSpacing(pair.points, pair.left), smallestSpacing(pair.points, pair.right));
  view.crowded = view.smallest_spacing < kRoom * options.corner_window;
  views.seen.push_back(views.views.size());
  views.pairs.push_back(std::move(pair));
  views.views.push_back(std::move(view));
}

void addPair(const cv::Mat& left, const cv::Mat& right, const BoardFinder& finder,
             const CalibrationOptions& options, CalibrationView view, BoardViews& views, bool search) {
  if (views.size.empty()) views.size = !left.empty() ? left.size() : right.size();
  if (left.empty()) {
    view.fault = ViewFault::kLeftUnreadable;
  } else if (right.empty()) {
    view.fault = ViewFault::kRightUnreadable;
  } else if (left.size() != views.size || right.size() != views.size) {
    view.fault = ViewFault::kWrongSize;
  } else {
    const auto in_left = search ? finder.find(left) : std::nullopt;
    const auto in_right = search ? finder.find(right) : std::nullopt;
    BoardPair pair;
    if (in_left && in_right) pair = finder.common(*in_left, *in_right);
    if (!in_left || !in_right) {
      view.fault = in_right  ? ViewFault::kBoardNotInLeft
                   : in_left ? ViewFault::kBoardNotInRight
                             : ViewFault::kBoardInNeither;
    } else if (!pair.enough()) {
      view.fault = ViewFault::kTooFewCorners;
    } else {
      return addCorners(std::move(pair), options, std::move(view), views);
    }
  }
  views.views.push_back(std::move(view));
}

BoardViews findBoards(const CalibrationInput& input, const CalibrationOptions& options,
                      base::Progress& progress, std::optional<cv::Size>* other) {
  BoardViews found;
  const BoardFinder finder(options);
  const std::size_t pairs = input.left.size();
  BoardSizeVotes votes(options);
  for (std::size_t i = 0; other && i < pairs && votes.undecided() && !progress.cancelled(); ++i)
    votes.observe(cv::imread(input.left[i].string(), cv::IMREAD_GRAYSCALE));
  if (other) *other = votes.other();
  for (std::size_t i = 0; i < pairs && !progress.cancelled(); ++i) {
    CalibrationView view;
    view.left = input.left[i].filename().string();
    view.right = input.right[i].filename().string();
    progress.report(0.6 * static_cast<double>(i) / static_cast<double>(pairs),
                    "finding the board in " + view.left);
    const cv::Mat left = cv::imread(input.left[i].string(), cv::IMREAD_GRAYSCALE);
    const cv::Mat right = cv::imread(input.right[i].string(), cv::IMREAD_GRAYSCALE);
    addPair(left, right, finder, options, std::move(view), found, votes.canHold());
  }
  return found;
}

}  // namespace capstan::vision
