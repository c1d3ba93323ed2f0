#include "core/vision/circle_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::vision {

namespace {

constexpr int kRays = EdgeSampler::kRays;
constexpr double kReach = 4.0;        // of a ray inside and outside the edge [px]
constexpr int kSamples = 17;          // along a ray, every half pixel at full reach
constexpr float kLeastContrast = 12;  // between marker and background, 8-bit levels
constexpr double kTukey = 4.685;      // 95 % efficient for Gaussian residuals
constexpr double kLeastScale = 0.03;  // of the residuals, so that exact images keep all edges [px]
constexpr int kLeastEdges = 10;

struct Edges {
  std::array<Eigen::Vector2d, kRays> points;
  int count = 0;
};

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

/// Where a profile from inside to outside falls half-way from its first to its last level; in samples, or −1.
double halfway(const std::array<float, kSamples>& profile) {
  const float inside = (profile[0] + profile[1] + profile[2]) / 3;
  const float outside = (profile[kSamples - 1] + profile[kSamples - 2] + profile[kSamples - 3]) / 3;
  if (inside - outside < kLeastContrast) return -1.0;
  const float middle = 0.5F * (inside + outside);
  for (int i = 1; i < kSamples; ++i) {
    if (profile[i] >= middle || profile[i - 1] < middle) continue;
    return i - 1 + (profile[i - 1] - middle) / (profile[i - 1] - profile[i]);
  }
  return -1.0;
}

struct Normal {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double weight = 0.0, squares = 0.0;
  int agreeing = 0;
};

double spread(const Edges& edges, const Circle& circle) {
  std::array<double, kRays> distances;
  for (int i = 0; i < edges.count; ++i)
    distances[i] = std::abs((edges.points[i] - circle.centre).norm() - circle.radius);
  const auto middle = distances.begin() + edges.count / 2;
  std::nth_element(distances.begin(), middle, distances.begin() + edges.count);
  return std::max(1.4826 * *middle, kLeastScale);
}

Normal normalEquations(const Edges& edges, const Circle& circle, double limit) {
  Normal sums;
  for (int i = 0; i < edges.count; ++i) {
    const Eigen::Vector2d arm = edges.points[i] - circle.centre;
    const double length = arm.norm();
    const double residual = length - circle.radius;
    if (std::abs(residual) >= limit || length == 0.0) continue;
    const double share = residual / limit;
    const double weight = (1.0 - share * share) * (1.0 - share * share);
    const Eigen::Vector3d gradient(arm.x() / length, arm.y() / length, 1.0);
    sums.matrix += weight * gradient * gradient.transpose();
    sums.right += weight * residual * gradient;
    sums.weight += weight;
    sums.squares += weight * residual * residual;
    ++sums.agreeing;
  }
  return sums;
}

/// Gauss–Newton on geometric distance with Tukey weights whose limit shrinks to the residuals' own spread.
CircleFit fitEdges(const Edges& edges, Circle circle) {
  constexpr int kSteps = 6;
  CircleFit fit;
  if (edges.count < kLeastEdges) return fit;
  double limit = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    limit = kTukey * spread(edges, circle);
    const Normal sums = normalEquations(edges, circle, limit);
    if (sums.agreeing < kLeastEdges) return fit;
    const Eigen::Vector3d change = sums.matrix.inverse() * sums.right;
    if (!change.allFinite() || change.head<2>().norm() > circle.radius) return fit;
    circle.centre += change.head<2>();
    circle.radius += change.z();
    if (change.cwiseAbs().maxCoeff() < 1e-3) break;
  }
  const Normal sums = normalEquations(edges, circle, limit);
  if (sums.agreeing < kLeastEdges || !(circle.radius > 0.0)) return fit;
  const double variance = sums.squares / std::max(sums.weight - 3.0, 1.0);
  const Eigen::Matrix3d covariance = variance * sums.matrix.inverse();
  fit.circle = circle;
  fit.rms = std::sqrt(variance);
  fit.sigma = std::sqrt(0.5 * (covariance(0, 0) + covariance(1, 1)));
  fit.edges = sums.agreeing;
  fit.coverage = static_cast<double>(sums.agreeing) / kRays;
  fit.valid = std::isfinite(fit.sigma);
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

EdgeSampler::EdgeSampler(const MarkerOptions& options) {
  const int high = options.hue_high + (options.hue_high < options.hue_low ? 180 : 0);
  const double hue = (options.hue_low + high) * 0.5 * 2.0 * std::numbers::pi / 180.0;
  const double third = 2.0 * std::numbers::pi / 3.0;
  // Unit vector of the hue in the plane of colours of equal R + G + B, scaled to 1 for the pure colour.
  weights_ = {static_cast<float>(std::cos(hue + third)), static_cast<float>(std::cos(hue - third)),
              static_cast<float>(std::cos(hue))};
}

float EdgeSampler::sample(const cv::Mat& bgr, double x, double y) const {
  const int column = static_cast<int>(x), line = static_cast<int>(y);
  const float u = static_cast<float>(x - column), v = static_cast<float>(y - line);
  const auto* top = bgr.ptr<std::uint8_t>(line) + 3 * static_cast<std::ptrdiff_t>(column);
  const auto* bottom = top + bgr.step[0];
  const auto chroma = [&](const std::uint8_t* p) {
    return weights_[0] * p[0] + weights_[1] * p[1] + weights_[2] * p[2];
  };
  const float upper = chroma(top) + u * (chroma(top + 3) - chroma(top));
  const float lower = chroma(bottom) + u * (chroma(bottom + 3) - chroma(bottom));
  return upper + v * (lower - upper);
}

CircleFit EdgeSampler::refine(const cv::Mat& bgr, const Circle& start) const {
  CircleFit fit;
  Circle circle = start;
  constexpr int kPasses = 2;
  for (int pass = 0; pass < kPasses; ++pass) {
    const double reach = std::min(kReach, 0.8 * circle.radius);
    const double step = 2.0 * reach / (kSamples - 1);
    Edges edges;
    for (const Eigen::Vector2d& direction : directions()) {
      const Eigen::Vector2d first = circle.centre + (circle.radius - reach) * direction;
      const Eigen::Vector2d last = circle.centre + (circle.radius + reach) * direction;
      const Eigen::Vector2d low = first.cwiseMin(last), high = first.cwiseMax(last);
      if (!(low.minCoeff() >= 0.0) || high.x() >= bgr.cols - 1 || high.y() >= bgr.rows - 1) continue;
      std::array<float, kSamples> profile;
      for (int i = 0; i < kSamples; ++i)
        profile[i] = sample(bgr, first.x() + i * step * direction.x(), first.y() + i * step * direction.y());
      const double at = halfway(profile);
      if (at >= 0.0) edges.points[edges.count++] = first + at * step * direction;
    }
    fit = fitEdges(edges, circle);
    if (!fit.valid) break;
    const bool settled =
        (fit.circle.centre - circle.centre).norm() < 0.5 && std::abs(fit.circle.radius - circle.radius) < 1.0;
    circle = fit.circle;
    if (settled) break;
  }
  return fit;
}

}  // namespace capstan::vision
