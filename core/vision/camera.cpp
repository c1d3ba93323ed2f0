#include "core/vision/camera.h"

#include <cmath>

#include "core/vision/distortion.h"

namespace capstan::vision {

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point) const {
  if (!(point.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d distorted = distort(distortion, point.head<2>() / point.z()).point;
  return Eigen::Vector2d(fx * distorted.x() + cx, fy * distorted.y() + cy);
}

Eigen::Vector2d Camera::normalise(const Eigen::Vector2d& pixel) const {
  return undistort(distortion, {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy}).point;
}

Distorted distort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& ideal) {
  const auto [k1, k2, p1, p2, k3] = coefficients;
  const double x = ideal.x(), y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // (1/r) d radial / dr
  Distorted out;
  out.point = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
               y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  const double cross = x * y * slope + 2.0 * (p1 * x + p2 * y);
  out.jacobian << radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
      radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return out;
}

Distorted undistort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& seen) {
  constexpr int kSteps = 20;
  constexpr double kLongestStep = 0.3;  // keeps the first steps inside the fold of a strong distortion
  Distorted at;
  Eigen::Vector2d ideal = seen;
  for (int step = 0; step < kSteps; ++step) {
    at = distort(coefficients, ideal);
    Eigen::Vector2d change = at.jacobian.inverse() * (seen - at.point);
    if (!change.allFinite()) break;
    const double length = change.norm();
    if (length > kLongestStep) change *= kLongestStep / length;
    ideal += change;
    if (length < 1e-13) break;
  }
  return {ideal, distort(coefficients, ideal).jacobian};
}

}  // namespace capstan::vision
