#include "core/vision/calibration_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"

namespace capstan::vision {

namespace {

constexpr double kNewest = 0.5;  // [s] after which the pair before says nothing about motion

cv::Mat greyOf(const cv::Mat& image) {
  cv::Mat grey;
  if (image.channels() == 1) return image;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

CalibrationViews::CalibrationViews(const CalibrationOptions& options)
    : options_(options), finder_(std::make_shared<BoardFinder>(options)), votes_(options) {}

/// The board moved little since the pair before.
bool CalibrationViews::still(const BoardPair& pair, double t) {
  const bool comparable = last_.size() == pair.left.size() && t > last_t_ && t - last_t_ < kNewest;
  double moved = 0.0;
  for (std::size_t i = 0; comparable && i < last_.size(); ++i)
    moved = std::max(moved, cv::norm(pair.left[i] - last_[i]));
  last_ = pair.left;
  last_t_ = t;
  return comparable && moved < kStill * std::hypot(boards_.size.width, boards_.size.height);
}

CalibrationViews::Observation CalibrationViews::observe(const cv::Mat& left, const cv::Mat& right, double t) {
  Observation seen;
  if (left.empty() || right.empty()) return seen;
  const cv::Mat grey_left = greyOf(left), grey_right = greyOf(right);
  if (boards_.size.empty()) boards_.size = grey_left.size();
  if (grey_left.size() != boards_.size || grey_right.size() != boards_.size) {
    seen.verdict = Verdict::kWrongSize;
    return seen;
  }
  if (views().empty() && votes_.undecided()) votes_.observe(grey_left);  // cheaper than a search in vain
  if (!votes_.canHold()) return seen;
  seen.left = finder_->find(grey_left);
  if (seen.left) seen.right = finder_->find(grey_right);
  if (!seen.left || !seen.right) return seen;
  const BoardPair pair = finder_->common(*seen.left, *seen.right);
  seen.verdict = Verdict::kTooFewCorners;
  if (!pair.enough()) return seen;
  seen.verdict = Verdict::kMoving;
  if (!still(pair, t)) return seen;
  const ViewShape shapes[] = {shapeOf(pair.points, pair.left, boards_.size),
                              shapeOf(pair.points, pair.right, boards_.size)};
  seen.verdict = Verdict::kSimilar;
  for (const ViewShape& taken : shapes_[0])
    if (shapes[0].distanceTo(taken) < kApart) return seen;
  seen.verdict = Verdict::kTaken;
  CalibrationView view;
  view.left = fmt::format("left{:02}.png", views().size() + 1);
  view.right = fmt::format("right{:02}.png", views().size() + 1);
  addCorners(pair, options_, view, boards_);
  for (const std::size_t side : {0U, 1U}) shapes_[side].push_back(shapes[side]);
  images_.push_back({grey_left.clone(), grey_right.clone()});
  return seen;
}

void CalibrationViews::addFiles(const CalibrationInput& input, base::Progress& progress) {
  BoardViews found = findBoards(input, options_, progress, &other_);
  if (progress.cancelled()) return;
  if (boards_.size.empty()) boards_.size = found.size;
  for (const std::size_t at : found.seen) boards_.seen.push_back(boards_.views.size() + at);
  for (CalibrationView& view : found.views) {
    if (view.used() && found.size != boards_.size) view.fault = ViewFault::kWrongSize;
    boards_.views.push_back(std::move(view));
    images_.emplace_back();
  }
  for (BoardPair& pair : found.pairs) {
    shapes_[0].push_back(shapeOf(pair.points, pair.left, boards_.size));
    shapes_[1].push_back(shapeOf(pair.points, pair.right, boards_.size));
    boards_.pairs.push_back(std::move(pair));
  }
}

bool CalibrationViews::usable(std::size_t view) const {
  const ViewFault fault = boards_.views[view].fault;
  return fault == ViewFault::kNone || fault == ViewFault::kExcluded;
}

void CalibrationViews::exclude(std::size_t view, bool out) {
  if (usable(view)) boards_.views[view].fault = out ? ViewFault::kExcluded : ViewFault::kNone;
}

BoardViews CalibrationViews::chosen() const {
  return boards_.without([](const CalibrationView& view) { return !view.used(); });
}

BoardCoverage CalibrationViews::coverage(int side) const {
  std::vector<ViewShape> used;
  for (std::size_t i = 0; i < boards_.seen.size(); ++i)
    if (boards_.views[boards_.seen[i]].used()) used.push_back(shapes_[static_cast<std::size_t>(side)][i]);
  return coverageOf(used);
}

std::vector<std::vector<cv::Point2f>> CalibrationViews::corners(int side) const {
  std::vector<std::vector<cv::Point2f>> all;
  for (const BoardPair& pair : chosen().pairs) all.push_back(side == 0 ? pair.left : pair.right);
  return all;
}

CalibrationReport CalibrationViews::calibrate(base::Progress& progress) const {
  return calibrateBoards(chosen(), options_, progress, otherBoard());
}

void CalibrationViews::saveImages(const std::filesystem::path& folder) const {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw base::InputError(
        {folder.string(), 0, {}, {}, "cannot be made: " + failed.message(), "Choose another folder"});
  for (std::size_t i = 0; i < images_.size(); ++i)
    for (const std::size_t side : {0U, 1U}) {
      if (images_[i][side].empty()) continue;
      const auto path = folder / (side == 0 ? views()[i].left : views()[i].right);
      if (!cv::imwrite(path.string(), images_[i][side]))
        throw base::InputError({path.string(), 0, {}, {}, "cannot be written", "Is the disk full?"});
    }
}

std::string wordsOf(CalibrationViews::Verdict verdict) {
  using V = CalibrationViews::Verdict;
  switch (verdict) {
    case V::kNotSeen:
      return "Show the whole board to both cameras.";
    case V::kTooFewCorners:
      return "Show more of the board to both cameras.";
    case V::kMoving:
      return "Hold the board still.";
    case V::kSimilar:
      return "Move the board: to another place, closer, farther, or tilted.";
    case V::kWrongSize:
      return "The images have another size than before: clear the views.";
    case V::kTaken:
      break;
  }
  return {};
}

}  // namespace capstan::vision
