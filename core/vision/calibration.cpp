#include "core/vision/calibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <optional>
#include <type_traits>

#include "core/base/error.h"
#include "core/stats/quantile.h"
#include "core/vision/board_coverage.h"
#include "core/vision/board_views.h"

namespace capstan::vision {

namespace {

constexpr std::size_t kLeastViews = 3;
constexpr double kOutlying = 3.0;  // smallest ratio of an outlying view's error to the median
const cv::TermCriteria kStop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12);

using Corners = std::vector<std::vector<cv::Point2f>>;

void check(const CalibrationInput& input, const CalibrationOptions& options) {
  if (input.left.size() != input.right.size())
    refuseCalibration(
        "images",
        std::to_string(input.left.size()) + " left, " + std::to_string(input.right.size()) + " right",
        "are not pairs", "Give as many left images as right ones, in the same order");
  CalibrationOptions::visit(options, [](const auto& value, const base::FieldInfo& info) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      if (!info.range.contains(static_cast<double>(value)))
        refuseCalibration(
            std::string(info.key), std::to_string(value),
            "is outside " + std::to_string(info.range.min) + " to " + std::to_string(info.range.max),
            "Choose a value in the range: " + std::string(info.meaning));
  });
}

struct Fit {
  cv::Mat matrix, distortion;
  double rms = 0.0;
  std::vector<double> errors;  ///< RMS of each view [px]
  CameraCalibration summary;
};

Fit fitCamera(const std::vector<std::vector<cv::Point3f>>& board, const Corners& corners,
              const cv::Size& size, const CalibrationOptions& options) {
  Fit fit;
  int flags = 0;
  if (options.square_pixels) flags |= cv::CALIB_FIX_ASPECT_RATIO;
  if (!options.fit_k3) flags |= cv::CALIB_FIX_K3;
  fit.matrix = cv::Mat::eye(3, 3, CV_64F);  // CALIB_FIX_ASPECT_RATIO keeps its ratio fx / fy = 1
  std::vector<cv::Mat> rotations, translations;
  cv::Mat intrinsic_sigma, extrinsic_sigma, view_errors;
  fit.rms = cv::calibrateCamera(board, corners, size, fit.matrix, fit.distortion, rotations, translations,
                                intrinsic_sigma, extrinsic_sigma, view_errors, flags, kStop);
  for (int i = 0; i < view_errors.rows; ++i) fit.errors.push_back(view_errors.at<double>(i));
  fit.summary = {fit.rms,
                 std::max(intrinsic_sigma.at<double>(0), intrinsic_sigma.at<double>(1)),
                 {intrinsic_sigma.at<double>(2), intrinsic_sigma.at<double>(3)}};
  return fit;
}

Camera cameraOf(const Fit& fit, const cv::Size& size, const std::string& name) {
  Camera camera;
  camera.name = name;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = fit.matrix.at<double>(0, 0);
  camera.fy = fit.matrix.at<double>(1, 1);
  camera.cx = fit.matrix.at<double>(0, 2);
  camera.cy = fit.matrix.at<double>(1, 2);
  for (int i = 0; i < 5; ++i) camera.distortion[static_cast<std::size_t>(i)] = fit.distortion.at<double>(i);
  return camera;
}

/// RMS distance of both images' corners from the epipolar lines of the other image, in pixels of the left
/// camera and of the right one.
double epipolarError(const BoardPair& pair, const Fit& left, const Fit& right, const cv::Mat& essential) {
  std::vector<cv::Point2f> in_left, in_right;
  cv::undistortPoints(pair.left, in_left, left.matrix, left.distortion);
  cv::undistortPoints(pair.right, in_right, right.matrix, right.distortion);
  const cv::Matx33d e(essential);
  double sum = 0.0;
  for (std::size_t i = 0; i < in_left.size(); ++i) {
    const cv::Vec3d l(in_left[i].x, in_left[i].y, 1.0), r(in_right[i].x, in_right[i].y, 1.0);
    const cv::Vec3d line_right = e * l, line_left = e.t() * r;
    const double off = r.dot(line_right);
    sum += std::pow(off / std::hypot(line_right(0), line_right(1)) * right.matrix.at<double>(0, 0), 2) +
           std::pow(off / std::hypot(line_left(0), line_left(1)) * left.matrix.at<double>(0, 0), 2);
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(in_left.size())));
}

void judgeViews(const BoardViews& boards, CalibrationReport& report) {
  std::vector<double> stereo_errors;
  double sum = 0.0, count = 0.0;
  std::vector<ViewShape> left, right;
  for (std::size_t i = 0; i < boards.seen.size(); ++i) {
    const BoardPair& pair = boards.pairs[i];
    const CalibrationView& view = report.views[boards.seen[i]];
    stereo_errors.push_back(view.stereo_error);
    const auto corners = static_cast<double>(pair.points.size());
    sum += corners * view.epipolar_error * view.epipolar_error;
    count += corners;
    left.push_back(shapeOf(pair.points, pair.left, boards.size));
    right.push_back(shapeOf(pair.points, pair.right, boards.size));
  }
  report.epipolar_rms = std::sqrt(sum / count);
  report.left_coverage = coverageOf(left);
  report.right_coverage = coverageOf(right);
  const double typical = stats::median(stereo_errors);
  for (const std::size_t i : boards.seen)
    report.views[i].outlying = report.views[i].stereo_error > kOutlying * typical;
}

/// Fits both cameras and the transform to all views in `boards`. Sets the report and the errors of the views.
void fitRig(const BoardViews& boards, const CalibrationOptions& options, base::Progress& progress,
            CalibrationReport& report) {
  std::vector<std::vector<cv::Point3f>> points;
  Corners left_corners, right_corners;
  for (const BoardPair& pair : boards.pairs) {
    points.push_back(pair.points);
    left_corners.push_back(pair.left);
    right_corners.push_back(pair.right);
  }
  progress.report(0.6, "fitting the left camera");
  const Fit left = fitCamera(points, left_corners, boards.size, options);
  progress.report(0.75, "fitting the right camera");
  const Fit right = fitCamera(points, right_corners, boards.size, options);
  progress.report(0.9, "fitting the transform between the cameras");
  cv::Mat rotation, translation, essential, fundamental, view_errors;
  cv::Mat left_matrix = left.matrix, left_distortion = left.distortion;
  cv::Mat right_matrix = right.matrix, right_distortion = right.distortion;
  // The intrinsics stay fixed: the fit of each single camera determines them better than the common poses do.
  report.stereo_rms =
      cv::stereoCalibrate(points, left_corners, right_corners, left_matrix, left_distortion, right_matrix,
                          right_distortion, boards.size, rotation, translation, essential, fundamental,
                          view_errors, cv::CALIB_FIX_INTRINSIC, kStop);
  report.left = left.summary;
  report.right = right.summary;
  report.rig.left = cameraOf(left, boards.size, "left");
  report.rig.right = cameraOf(right, boards.size, "right");
  for (int i = 0; i < 3; ++i) {
    report.rig.right_from_left.translation()(i) = translation.at<double>(i);
    for (int j = 0; j < 3; ++j) report.rig.right_from_left.linear()(i, j) = rotation.at<double>(i, j);
  }
  report.views_used = static_cast<int>(boards.seen.size());
  for (std::size_t i = 0; i < boards.seen.size(); ++i) {
    CalibrationView& view = report.views[boards.seen[i]];
    view.left_error = left.errors[i];
    view.right_error = right.errors[i];
    const int row = static_cast<int>(i);
    view.stereo_error = std::sqrt(
        0.5 * (std::pow(view_errors.at<double>(row, 0), 2) + std::pow(view_errors.at<double>(row, 1), 2)));
    view.epipolar_error = epipolarError(boards.pairs[i], left, right, essential);
  }
  judgeViews(boards, report);
}

/// Removes from `boards` the views beyond `factor` times the median error and marks them in the report.
bool dropOutliers(BoardViews& boards, double factor, CalibrationReport& report) {
  std::vector<double> errors;
  for (const std::size_t i : boards.seen) errors.push_back(report.views[i].stereo_error);
  const double limit = factor * stats::median(errors);
  for (const std::size_t i : boards.seen) {
    CalibrationView& view = report.views[i];
    if (view.stereo_error <= limit) continue;
    view.fault = ViewFault::kBadView;
    view.outlying = false;
  }
  boards.views = report.views;
  const std::size_t before = boards.seen.size();
  boards = boards.without([](const CalibrationView& view) { return !view.used(); });
  return boards.seen.size() < before;
}

void requireViews(const BoardViews& boards, const CalibrationReport& report,
                  const CalibrationOptions& options, const std::optional<cv::Size>& other) {
  if (boards.seen.size() >= kLeastViews) return;
  if (other)
    refuseCalibration("board",
                      std::to_string(options.board_columns) + "x" + std::to_string(options.board_rows),
                      "is not the size of the board: the images show one of " + std::to_string(other->width) +
                          "x" + std::to_string(other->height) + " inner corners",
                      "Give that size");
  std::string reasons;
  for (const CalibrationView& view : report.views)
    if (!view.used()) reasons += "; " + view.left + ": " + std::string(base::nameOf(view.fault));
  refuseCalibration(
      "pairs", std::to_string(boards.seen.size()) + " usable of " + std::to_string(report.views.size()),
      "is fewer than 3" + reasons,
      "Check board_columns and board_rows (inner corners), and take more pairs that show the whole board");
}

}  // namespace

CalibrationReport calibrateBoards(BoardViews boards, const CalibrationOptions& options,
                                  base::Progress& progress, const std::optional<cv::Size>& other) {
  CalibrationReport report;
  report.views = boards.views;
  if (other) report.other_board = {other->width, other->height};
  requireViews(boards, report, options, other);
  fitRig(boards, options, progress, report);
  if (options.outlier_factor > 0.0 && dropOutliers(boards, options.outlier_factor, report)) {
    requireViews(boards, report, options, {});
    fitRig(boards, options, progress, report);
  }
  report.cancelled = progress.cancelled();
  if (!report.cancelled) progress.report(1.0, "calibrated");
  return report;
}

CalibrationReport calibrateStereo(const CalibrationInput& input, const CalibrationOptions& options,
                                  base::Progress& progress) {
  check(input, options);
  std::optional<cv::Size> other;
  BoardViews boards = findBoards(input, options, progress, &other);
  if (!progress.cancelled()) return calibrateBoards(std::move(boards), options, progress, other);
  CalibrationReport report;
  report.views = boards.views;
  report.cancelled = true;
  return report;
}

std::vector<std::string> BoardCoverage::missing() const {
  std::vector<std::string> lines;
  const auto add = [&](double covered, const char* what) {
    if (covered < 1.0) lines.emplace_back(what);
  };
  add(x, "the board near the left and right edges");
  add(y, "the board near the upper and lower edges");
  add(size, "the board closer to the camera");
  add(skew, "the board tilted");
  return lines;
}

}  // namespace capstan::vision
