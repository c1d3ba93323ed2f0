#include "core/vision/marker_detector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace capstan::vision {

namespace {

/// Error of the centre that the residuals of the fit do not contain (interpolation, shading across the edge),
/// measured on rendered balls [px].
constexpr double kSigmaFloor = 0.04;
/// Standard deviation of a contour's centroid when no circle could be fitted to the image [px].
constexpr double kContourSigma = 0.25;
/// Largest residual of a round marker's edge: absolute [px] and as a share of the radius. The edges of
/// rendered balls leave 0.1 px at most; those of a red mark on a da Vinci jaw 0.17 to 0.93 px.
constexpr double kLargestRoundRms = 0.15, kLargestRoundShare = 0.02;
/// Limits for a marker that the border cuts, by its arc: smallest share of the circle, largest residual [px].
constexpr double kLeastCutCoverage = 0.3, kLargestCutRms = 0.75;

}  // namespace

MarkerDetector::MarkerDetector(const MarkerOptions& options, int max_width, int max_height)
    : options_(options),
      max_width_(max_width),
      max_height_(max_height),
      threshold_(options),
      raw_(max_width, max_height),
      median_(max_width, max_height),
      eroded_(max_width, max_height),
      cleaned_(max_width, max_height),
      median_scratch_(max_width, max_height),
      blobs_(max_width, max_height),
      edges_(options) {}

MarkerDetection MarkerDetector::detect(const cv::Mat& bgr) {
  MarkerDetection found = search(bgr, cv::Rect(0, 0, bgr.cols, bgr.rows));
  found.full_frame = true;
  return found;
}

MarkerDetection MarkerDetector::detect(const cv::Mat& bgr, const cv::Rect& roi) {
  return search(bgr, roi & cv::Rect(0, 0, bgr.cols, bgr.rows));
}

MarkerDetection MarkerDetector::search(const cv::Mat& bgr, const cv::Rect& roi) {
  MarkerDetection found;
  found.roi = {roi.x, roi.y, roi.width, roi.height};
  rows_ = {};
  if (bgr.empty() || roi.empty()) return found;
  if (bgr.type() != CV_8UC3 || roi.width > max_width_ || roi.height > max_height_) {
    found.fault = MarkerFault::kWrongImage;
    return found;
  }
  const RowSpan raw_rows = threshold_.apply(bgr(roi), raw_);
  const RowSpan median_rows = median5x5(raw_, raw_rows, median_scratch_, median_);
  rows_ = erode3x3(median_, median_rows, eroded_);
  rows_ = dilate3x3(eroded_, rows_, cleaned_);
  cleaned_.resize(roi.width, roi.height);

  const std::span<const Blob> blobs = blobs_.find(cleaned_, rows_);
  if (blobs.empty()) {
    // Pixels that pass the median but not the erosion are more than noise, but no marker.
    const bool speck = median_.anySet(median_rows.first, median_rows.last);
    found.fault = speck ? MarkerFault::kTooSmall : MarkerFault::kNoPixels;
    return found;
  }
  fillShape(bgr, roi, blobs.front(), found);
  if (found.fault == MarkerFault::kNone && blobs.size() > 1 &&
      blobs[1].area >= options_.candidate_ratio * blobs[0].area)
    found.fault = MarkerFault::kTwoCandidates;
  return found;
}

void MarkerDetector::fillShape(const cv::Mat& bgr, const cv::Rect& roi, const Blob& blob,
                               MarkerDetection& found) {
  const ContourMoments contour = blobs_.trace(cleaned_, blob);
  const Eigen::Vector2d corner(roi.x, roi.y);
  found.area = blob.area;
  found.contour_centroid = corner + contour.centroid;
  found.centroid = found.contour_centroid;
  // The polygon connects pixel centres: half a pixel of the blob lies outside the polygon.
  found.radius = std::sqrt(contour.area / std::numbers::pi) + 0.5;
  found.sigma = kContourSigma;
  found.circularity =
      contour.perimeter > 0.0
          ? std::min(1.0, 4.0 * std::numbers::pi * contour.area / (contour.perimeter * contour.perimeter))
          : 0.0;
  const bool cut =
      blob.left == 0 || blob.top == 0 || blob.right == roi.width - 1 || blob.bottom == roi.height - 1;
  Circle start{found.centroid, found.radius};
  if (cut) {
    const Circle arc = fitContourCircle(blobs_.contour(), roi.width, roi.height);
    if (arc.radius > 0.0) start = {corner + arc.centre, arc.radius + 0.5};
  }
  found.fault = MarkerFault::kNone;
  if (std::max(found.radius, start.radius) < options_.min_radius) {
    found.fault = MarkerFault::kTooSmall;
    return;
  }
  if (!cut && found.circularity < options_.min_circularity) {
    found.fault = MarkerFault::kNotRound;
    return;
  }
  const CircleFit fit = edges_.refine(bgr, start);
  const bool round = cut || fit.rms <= std::max(kLargestRoundRms, kLargestRoundShare * fit.circle.radius);
  if (fit.valid && !round) found.sigma = std::max(kContourSigma, fit.rms);
  if (fit.valid && round) {
    found.centroid = fit.circle.centre;
    found.radius = fit.circle.radius;
    found.sigma = std::hypot(fit.sigma, kSigmaFloor);
  }
  if (cut && !(fit.valid && fit.coverage >= kLeastCutCoverage && fit.rms <= kLargestCutRms))
    found.fault = MarkerFault::kNotRound;
}

cv::Mat MarkerDetector::mask() const {
  cv::Mat image = cv::Mat::zeros(cleaned_.height(), cleaned_.width(), CV_8U);
  for (int y = rows_.first; y <= rows_.last; ++y)
    for (int x = 0; x < image.cols; ++x) image.at<std::uint8_t>(y, x) = cleaned_.at(x, y) ? 255 : 0;
  return image;
}

cv::Rect roiAround(const Eigen::Vector2d& pixel, const MarkerOptions& options, const cv::Size& size) {
  const int side = options.roi_size;
  const cv::Rect frame(cv::Point(0, 0), size);
  if (!pixel.allFinite() || pixel.cwiseAbs().maxCoeff() > 1e6) return {};
  const cv::Rect wanted(static_cast<int>(std::lround(pixel.x())) - side / 2,
                        static_cast<int>(std::lround(pixel.y())) - side / 2, side, side);
  if ((wanted & frame).empty()) return {};
  const int x = std::clamp(wanted.x, 0, std::max(0, size.width - side));
  const int y = std::clamp(wanted.y, 0, std::max(0, size.height - side));
  return cv::Rect(x, y, side, side) & frame;
}

}  // namespace capstan::vision
