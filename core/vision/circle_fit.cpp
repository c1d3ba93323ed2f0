#include "core/vision/circle_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::vision {

namespace {

constexpr int kRays = EdgeSampler::kRays;
constexpr double kReach = 4.0;        // length of a ray inside and outside the edge [px]
constexpr int kSamples = 11;          // samples along a ray, 0.8 px apart at full reach
constexpr float kLeastContrast = 12;  // smallest contrast of marker and background, 8-bit levels
constexpr double kTukey = 4.685;      // 95 % efficient for Gaussian residuals
constexpr double kLeastScale = 0.03;  // smallest residual scale, so that exact images keep all edges [px]
constexpr int kLeastEdges = 10;
constexpr double kPatchMargin = 1.5;  // distance that a circle may move inside its patch [px]

using Edges = EdgeSampler::Edges;

const std::array<Eigen::Vector2d, kRays>& directions() {
  static const auto table = [] {
    std::array<Eigen::Vector2d, kRays> made;
    for (int i = 0; i < kRays; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kRays;
      made[i] = {std::cos(angle), std::sin(angle)};
    }
    return made;
  }();
  return table;
}

/// Position, in samples, at which a profile from inside to outside falls half-way from the level of the
/// marker to that of the background; −1 when there is none. A ball darkens towards its rim on the side away
/// from the light, so the marker's level is extrapolated from the first three samples with a share of their
/// slope. Part of the slope is blur of the lens: the share below gives the smallest error of the centre on
/// rendered balls with flat to strong shading (a share of 0 doubles the error at mild shading, 1 triples it).
double halfway(const std::array<float, kSamples>& profile) {
  constexpr float kSlopeShare = 0.4F;
  const float inside = (profile[0] + profile[1] + profile[2]) / 3;
  const float outside = (profile[kSamples - 1] + profile[kSamples - 2] + profile[kSamples - 3]) / 3;
  if (inside - outside < kLeastContrast) return -1.0;
  const float slope = kSlopeShare * 0.5F * (profile[2] - profile[0]);
  const auto excess = [&](int i) {  // level of sample i above the half-way level
    const float marker = std::max(inside + slope * static_cast<float>(i - 1), outside + kLeastContrast);
    return profile[i] - 0.5F * (marker + outside);
  };
  float before = excess(0);
  for (int i = 1; i < kSamples; ++i) {
    const float here = excess(i);
    if (before >= 0.0F && here < 0.0F) return i - 1 + before / (before - here);
    before = here;
  }
  return -1.0;
}

/// Edge points relative to the centre of a circle.
struct Residuals {
  std::array<Eigen::Vector2d, kRays> directions;
  std::array<double, kRays> values;  ///< distance from the circle, positive outside [px]

  Residuals(const Edges& edges, const Circle& circle) {
    for (int i = 0; i < edges.count; ++i) {
      const Eigen::Vector2d arm = edges.points[i] - circle.centre;
      const double length = std::max(arm.norm(), 1e-9);
      directions[i] = arm / length;
      values[i] = length - circle.radius;
    }
  }
};

/// Robust standard deviation of the residuals, from the median of their magnitudes.
double spread(const Residuals& residuals, int count) {
  std::array<double, kRays> sizes;
  for (int i = 0; i < count; ++i) sizes[i] = std::abs(residuals.values[i]);
  const auto middle = sizes.begin() + count / 2;
  std::nth_element(sizes.begin(), middle, sizes.begin() + count);
  return std::max(1.4826 * *middle, kLeastScale);
}

struct Normal {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double weight = 0.0, squares = 0.0;
  int agreeing = 0;
};

Normal normalEquations(const Residuals& residuals, int count, double limit) {
  Normal sums;
  for (int i = 0; i < count; ++i) {
    const double share = residuals.values[i] / limit;
    if (std::abs(share) >= 1.0) continue;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    const Eigen::Vector3d gradient(residuals.directions[i].x(), residuals.directions[i].y(), 1.0);
    sums.matrix.noalias() += weight * gradient * gradient.transpose();
    sums.right += weight * residuals.values[i] * gradient;
    sums.weight += weight;
    sums.squares += weight * residuals.values[i] * residuals.values[i];
    ++sums.agreeing;
  }
  return sums;
}

/// Gauss–Newton fit on geometric distance with Tukey weights; their limit follows the residuals' spread.
CircleFit fitEdges(const Edges& edges, Circle circle, int least) {
  constexpr int kSteps = 5;
  constexpr double kSettled = 5e-3;  // [px]
  CircleFit fit;
  if (edges.count < least) return fit;
  for (int step = 0; step < kSteps; ++step) {
    const Residuals residuals(edges, circle);
    const Normal sums = normalEquations(residuals, edges.count, kTukey * spread(residuals, edges.count));
    if (sums.agreeing < least) return fit;
    const Eigen::Matrix3d inverse = sums.matrix.inverse();
    const Eigen::Vector3d change = inverse * sums.right;
    if (!change.allFinite() || change.head<2>().norm() > circle.radius) return fit;
    circle.centre += change.head<2>();
    circle.radius += change.z();
    const double variance = sums.squares / std::max(sums.weight - 3.0, 1.0);
    fit.rms = std::sqrt(variance);
    fit.sigma = std::sqrt(0.5 * variance * (inverse(0, 0) + inverse(1, 1)));
    fit.edges = sums.agreeing;
    if (change.cwiseAbs().maxCoeff() < kSettled) break;
  }
  fit.circle = circle;
  fit.coverage = static_cast<double>(fit.edges) / kRays;
  fit.valid = std::isfinite(fit.sigma) && circle.radius > 0.0;
  return fit;
}

}  // namespace

Circle fitContourCircle(std::span<const ContourPoint> contour, int width, int height) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  if (contour.empty()) return {};
  const Eigen::Vector2d origin(contour.front().x, contour.front().y);
  int used = 0;
  for (const ContourPoint& point : contour) {
    if (point.x <= 0 || point.y <= 0 || point.x >= width - 1 || point.y >= height - 1) continue;
    const Eigen::Vector2d p = Eigen::Vector2d(point.x, point.y) - origin;
    const Eigen::Vector3d row(p.x(), p.y(), 1.0);
    matrix += row * row.transpose();
    right += row * p.squaredNorm();
    ++used;
  }
  constexpr int kLeastPoints = 6;
  if (used < kLeastPoints) return {};
  const Eigen::Vector3d solution = matrix.inverse() * right;  // x² + y² = 2 a x + 2 b y + c
  if (!solution.allFinite()) return {};
  const Eigen::Vector2d centre = 0.5 * solution.head<2>();
  const double squared = solution.z() + centre.squaredNorm();
  if (!(squared > 0.0)) return {};
  return {origin + centre, std::sqrt(squared)};
}

EdgeSampler::EdgeSampler(const MarkerOptions& options)
    : chroma_(static_cast<std::size_t>(kPatchSide) * (kPatchSide + 1)) {
  const int high = options.hue_high + (options.hue_high < options.hue_low ? 180 : 0);
  const double hue = (options.hue_low + high) * 0.5 * 2.0 * std::numbers::pi / 180.0;
  const double third = 2.0 * std::numbers::pi / 3.0;
  // Unit vector of the hue in the plane of colours of equal R + G + B, scaled to 1 for the pure colour.
  weights_ = {static_cast<float>(std::cos(hue + third)), static_cast<float>(std::cos(hue - third)),
              static_cast<float>(std::cos(hue))};
}

CircleFit EdgeSampler::refine(const cv::Mat& bgr, const Circle& start) {
  // The first fit uses every third ray. Then all rays are used, until the edges no longer depend on the start
  // of the rays.
  constexpr int kRoughStride = 3, kLeastRoughEdges = 4;
  constexpr int kPasses = 3;
  constexpr double kSettled = 0.2;  // [px]
  Patch patch = takePatch(bgr, start);
  CircleFit fit = fitEdges(collectEdges(start, patch, kRoughStride), start, kLeastRoughEdges);
  for (int pass = 0; pass < kPasses && fit.valid; ++pass) {
    const Circle circle = fit.circle;
    const double moved =
        (circle.centre - start.centre).cwiseAbs().maxCoeff() + std::abs(circle.radius - start.radius);
    if (moved > kPatchMargin) patch = takePatch(bgr, circle);
    fit = fitEdges(collectEdges(circle, patch, 1), circle, kLeastEdges);
    if ((fit.circle.centre - circle.centre).norm() < kSettled &&
        std::abs(fit.circle.radius - circle.radius) < 2.0 * kSettled)
      break;
  }
  return fit;
}

EdgeSampler::Patch EdgeSampler::takePatch(const cv::Mat& bgr, const Circle& circle) {
  const double outer = circle.radius + kReach + kPatchMargin;
  Patch patch;
  patch.stride = std::max(1, static_cast<int>(std::ceil(2.0 * outer / (kPatchSide - 2))));
  const auto first = [&](double centre) {
    return static_cast<int>(std::floor(std::max(0.0, centre - outer)));
  };
  patch.x = first(circle.centre.x());
  patch.y = first(circle.centre.y());
  const auto count = [&](double centre, int from, int size) {
    const int last = static_cast<int>(std::min(size - 1.0, std::ceil(centre + outer)));
    return std::clamp((last - from) / patch.stride + 1, 0, kPatchSide);
  };
  patch.width = count(circle.centre.x(), patch.x, bgr.cols);
  patch.height = count(circle.centre.y(), patch.y, bgr.rows);
  for (int row = 0; row < patch.height; ++row) {
    const auto* pixel =
        bgr.ptr<std::uint8_t>(patch.y + row * patch.stride) + 3 * static_cast<std::ptrdiff_t>(patch.x);
    float* out = chroma_.data() + static_cast<std::ptrdiff_t>(row) * kPatchSide;
    for (int column = 0; column < patch.width;
         ++column, pixel += 3 * static_cast<std::ptrdiff_t>(patch.stride))
      out[column] = weights_[0] * static_cast<float>(pixel[0]) + weights_[1] * static_cast<float>(pixel[1]) +
                    weights_[2] * static_cast<float>(pixel[2]);
  }
  return patch;
}

EdgeSampler::Edges EdgeSampler::collectEdges(const Circle& circle, const Patch& patch, int stride) const {
  const double reach = std::min(kReach, 0.8 * circle.radius);
  const double step = 2.0 * reach / (kSamples - 1);
  const double scale = 1.0 / patch.stride;
  Edges edges;
  for (int ray = 0; ray < kRays; ray += stride) {
    const Eigen::Vector2d& direction = directions()[ray];
    const Eigen::Vector2d first = circle.centre + (circle.radius - reach) * direction;
    const Eigen::Vector2d start = (first - Eigen::Vector2d(patch.x, patch.y)) * scale;
    const Eigen::Vector2d along = step * scale * direction;
    const Eigen::Vector2d end = start + (kSamples - 1) * along;
    const Eigen::Vector2d low = start.cwiseMin(end), high = start.cwiseMax(end);
    if (!(low.minCoeff() >= 0.0) || high.x() >= patch.width - 1 || high.y() >= patch.height - 1) continue;
    const auto x0 = static_cast<float>(start.x()), y0 = static_cast<float>(start.y());
    const auto dx = static_cast<float>(along.x()), dy = static_cast<float>(along.y());
    std::array<float, kSamples> profile;
    for (int i = 0; i < kSamples; ++i) {
      const float x = x0 + static_cast<float>(i) * dx, y = y0 + static_cast<float>(i) * dy;
      const int column = static_cast<int>(x), line = static_cast<int>(y);
      const float u = x - static_cast<float>(column), v = y - static_cast<float>(line);
      const float* top = chroma_.data() + static_cast<std::ptrdiff_t>(line) * kPatchSide + column;
      const float upper = top[0] + u * (top[1] - top[0]);
      const float lower = top[kPatchSide] + u * (top[kPatchSide + 1] - top[kPatchSide]);
      profile[i] = upper + v * (lower - upper);
    }
    const double at = halfway(profile);
    if (at >= 0.0) edges.points[edges.count++] = first + at * step * direction;
  }
  return edges;
}

}  // namespace capstan::vision
