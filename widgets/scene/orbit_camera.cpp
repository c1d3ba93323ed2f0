#include "widgets/scene/orbit_camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace capstan::widgets {

using Eigen::Vector3d;

namespace {
constexpr double kSteepest = 1.53;  // [rad] short of the pole, where the turntable has no azimuth
}

void OrbitCamera::setAxes(const Vector3d& up, const Vector3d& ahead) {
  up_ = up.normalized();
  ahead_ = (ahead - ahead.dot(up_) * up_).normalized();
}

void OrbitCamera::look(const Vector3d& focus, double distance, double azimuth, double elevation) {
  focus_ = focus;
  distance_ = distance;
  azimuth_ = azimuth;
  elevation_ = std::clamp(elevation, -kSteepest, kSteepest);
}

void OrbitCamera::orbit(double azimuth, double elevation) {
  azimuth_ = std::remainder(azimuth_ + azimuth, 2.0 * M_PI);
  elevation_ = std::clamp(elevation_ + elevation, -kSteepest, kSteepest);
}

void OrbitCamera::pan(double right, double up) {
  const double height = 2.0 * distance_ * std::tan(0.5 * view_angle_);
  const Eigen::Matrix3d r = axes();
  focus_ += height * (right * r.col(0) + up * r.col(1));
}

void OrbitCamera::zoom(double factor) { distance_ = std::clamp(distance_ * factor, 0.05, 10.0); }

Vector3d OrbitCamera::position() const {
  const Vector3d side = up_.cross(ahead_);
  return focus_ +
         distance_ * (std::cos(elevation_) * (std::cos(azimuth_) * ahead_ + std::sin(azimuth_) * side) +
                      std::sin(elevation_) * up_);
}

Eigen::Matrix3d OrbitCamera::axes() const {
  Eigen::Matrix3d r;
  r.col(2) = (position() - focus_).normalized();
  r.col(0) = up_.cross(r.col(2)).normalized();
  r.col(1) = r.col(2).cross(r.col(0));
  return r;
}

Vector3d OrbitCamera::viewUp() const { return axes().col(1); }

std::optional<QPointF> OrbitCamera::project(const Vector3d& point, const QSize& size) const {
  const Vector3d seen = axes().transpose() * (point - position());
  if (seen.z() > -1e-6) return std::nullopt;
  const double focal = 0.5 * size.height() / std::tan(0.5 * view_angle_);
  return QPointF(0.5 * size.width() - focal * seen.x() / seen.z(),
                 0.5 * size.height() + focal * seen.y() / seen.z());
}

}  // namespace capstan::widgets
