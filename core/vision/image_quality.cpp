#include "core/vision/image_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace capstan::vision {
namespace {

constexpr double kFine = 1.0, kCoarse = 2.0;  // smoothing before the gradients [px]
constexpr double kDifference = 1.0 / 3.0;     // variance of a central difference, a box of 2 px [px²]
constexpr float kLeastGradient = 3.0F;        // levels per px: five times that of noise of 3 levels
constexpr std::size_t kLeastEdges = 40;       // of which a quarter is used
constexpr double kWidest = 20.0;              // [px] blur of edges without measurable curvature

/// Magnitude of the gradient of `grey` smoothed by sigma [levels per px].
cv::Mat gradientOf(const cv::Mat& grey, double sigma, cv::Mat* across = nullptr, cv::Mat* down = nullptr) {
  cv::Mat smooth, x, y, magnitude;
  cv::GaussianBlur(grey, smooth, {}, sigma, sigma, cv::BORDER_REPLICATE);
  const cv::Mat difference = (cv::Mat_<float>(1, 3) << -0.5F, 0.0F, 0.5F);
  cv::filter2D(smooth, x, CV_32F, difference);
  cv::filter2D(smooth, y, CV_32F, difference.t());
  cv::magnitude(x, y, magnitude);
  if (across) *across = x;
  if (down) *down = y;
  return magnitude;
}

/// Whether the gradient is largest here along its own direction, to the next pixels.
bool isRidge(const cv::Mat& magnitude, const cv::Mat& x, const cv::Mat& y, int row, int column) {
  const bool level = std::abs(x.at<float>(row, column)) > std::abs(y.at<float>(row, column));
  const int dx = level ? 1 : 0, dy = level ? 0 : 1;
  const float here = magnitude.at<float>(row, column);
  return here >= magnitude.at<float>(row - dy, column - dx) &&
         here > magnitude.at<float>(row + dy, column + dx);
}

double blurOf(double fine, double coarse) {
  const double ratio = fine / coarse;
  const double fine_variance = kFine * kFine + kDifference, coarse_variance = kCoarse * kCoarse + kDifference;
  const double excess = ratio * ratio - 1.0;
  if (excess <= 0.0) return kWidest;
  return std::min(kWidest,
                  std::sqrt(std::max(0.0, (coarse_variance - ratio * ratio * fine_variance) / excess)));
}

}  // namespace

Exposure exposureOf(const cv::Mat& bgr, const CircleArea& area) {
  std::array<double, 256> levels{};
  double count = 0.0;
  for (int row = 0; row < bgr.rows; ++row) {
    const auto* pixel = bgr.ptr<cv::Vec3b>(row);
    for (int column = 0; column < bgr.cols; ++column) {
      if (area.radius > 0.0 && std::hypot(column - area.x, row - area.y) > area.radius) continue;
      ++levels[std::max({pixel[column][0], pixel[column][1], pixel[column][2]})];
      ++count;
    }
  }
  Exposure exposure;
  if (count == 0.0) return exposure;
  double below = 0.0;
  bool past_median = false, past_bright = false;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double share = levels[level] / count;
    below += share;
    exposure.histogram[level * kHistogramBins / levels.size()] += share;
    if (level >= kClipped) exposure.clipped += share;
    if (!std::exchange(past_median, below >= 0.5) && past_median)
      exposure.median = static_cast<double>(level);
    if (!std::exchange(past_bright, below >= 0.95) && past_bright)
      exposure.bright = static_cast<double>(level);
  }
  return exposure;
}

double edgeBlur(const cv::Mat& bgr) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (bgr.rows < 3 || bgr.cols < 3) return kNone;
  cv::Mat grey, x, y;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  const cv::Mat fine = gradientOf(grey, kFine, &x, &y), coarse = gradientOf(grey, kCoarse);
  struct Edge {
    float strength;
    double blur;
  };
  std::vector<Edge> edges;
  for (int row = 1; row + 1 < grey.rows; ++row)
    for (int column = 1; column + 1 < grey.cols; ++column) {
      const float strength = fine.at<float>(row, column);
      if (strength < kLeastGradient || !isRidge(fine, x, y, row, column)) continue;
      const float wide = coarse.at<float>(row, column);  // by this one, noise does not choose sharp edges
      edges.push_back({wide, blurOf(strength, wide)});
    }
  if (edges.size() < kLeastEdges) return kNone;
  const auto quarter = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 4);
  std::nth_element(edges.begin(), quarter, edges.end(),
                   [](const Edge& a, const Edge& b) { return a.strength > b.strength; });
  const auto middle = edges.begin() + (quarter - edges.begin()) / 2;
  std::nth_element(edges.begin(), middle, quarter,
                   [](const Edge& a, const Edge& b) { return a.blur < b.blur; });
  return middle->blur;
}

}  // namespace capstan::vision
