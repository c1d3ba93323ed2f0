#include "core/vision/triangulation.h"

#include <Eigen/LU>
#include <cmath>

#include "core/base/check.h"
#include "core/vision/distortion.h"

namespace capstan::vision {

namespace {

/// Ideal (undistorted) image coordinates of a pixel and their information matrix [1 / (x/z)²].
struct Observation {
  Eigen::Vector2d ideal;
  Eigen::Matrix2d information;
};

Observation observationOf(const Camera& camera, const Eigen::Vector2d& pixel, double sigma_px) {
  const Distorted seen = undistort(
      camera.distortion, {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy});
  const Eigen::Matrix2d pixel_by_ideal = Eigen::Vector2d(camera.fx, camera.fy).asDiagonal() * seen.jacobian;
  return {seen.point, pixel_by_ideal.transpose() * pixel_by_ideal / (sigma_px * sigma_px)};
}

/// Adds the terms of one camera to the normal equations at `point` in that camera's frame; `rotation` rotates
/// from the frame of the unknown to the camera's frame. Returns the weighted squared residual.
double addObservation(const Observation& observation, const Eigen::Vector3d& point,
                      const Eigen::Matrix3d& rotation, Eigen::Matrix3d& information, Eigen::Vector3d& right) {
  const double inverse = 1.0 / point.z();
  const Eigen::Vector2d image = point.head<2>() * inverse;
  Eigen::Matrix<double, 2, 3> projection;
  projection << inverse, 0.0, -image.x() * inverse, 0.0, inverse, -image.y() * inverse;
  const Eigen::Matrix<double, 2, 3> jacobian = projection * rotation;
  const Eigen::Vector2d residual = observation.ideal - image;
  const Eigen::Matrix<double, 3, 2> weighted = jacobian.transpose() * observation.information;
  information += weighted * jacobian;
  right += weighted * residual;
  return residual.dot(observation.information * residual);
}

}  // namespace

Triangulator::Triangulator(const StereoRig& rig)
    : rig_(rig), rotation_(rig.right_from_left.linear()), translation_(rig.right_from_left.translation()) {
  Eigen::Matrix3d cross;
  cross << 0.0, -translation_.z(), translation_.y(), translation_.z(), 0.0, -translation_.x(),
      -translation_.y(), translation_.x(), 0.0;
  essential_ = cross * rotation_;
}

Triangulation Triangulator::triangulate(const Eigen::Vector2d& left_px, const Eigen::Vector2d& right_px,
                                        double sigma_px_left, double sigma_px_right) const {
  CAPSTAN_ASSERT(sigma_px_left > 0.0 && sigma_px_right > 0.0);
  Triangulation out;
  const Observation left = observationOf(rig_.left, left_px, sigma_px_left);
  const Observation right = observationOf(rig_.right, right_px, sigma_px_right);
  const Eigen::Vector3d line = essential_ * left.ideal.homogeneous();
  out.epipolar_residual =
      right.ideal.homogeneous().dot(line) / line.head<2>().norm() * std::sqrt(rig_.right.fx * rig_.right.fy);

  // Mid-point of the rays s a and c + t b, all in the left frame.
  const Eigen::Vector3d a = left.ideal.homogeneous(), b = rotation_.transpose() * right.ideal.homogeneous();
  const Eigen::Vector3d c = -rotation_.transpose() * translation_;
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double determinant = aa * bb - ab * ab;
  constexpr double kParallel = 1e-12;  // squared sine of the rays' angle: a micro-radian
  if (!(determinant > kParallel * aa * bb)) return out;
  const double s = (bb * a.dot(c) - ab * b.dot(c)) / determinant;
  const double t = (ab * a.dot(c) - aa * b.dot(c)) / determinant;
  out.position = 0.5 * (s * a + c + t * b);
  out.fault = TriangulationFault::kBehindCamera;
  if (!(s > 0.0) || !(t > 0.0)) return out;

  constexpr int kSteps = 3;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Vector3d in_right = rotation_ * out.position + translation_;
    if (!(out.position.z() > 0.0) || !(in_right.z() > 0.0)) return out;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    out.chi_square = addObservation(left, out.position, Eigen::Matrix3d::Identity(), information, gradient) +
                     addObservation(right, in_right, rotation_, information, gradient);
    out.covariance = information.inverse();
    const Eigen::Vector3d change = out.covariance * gradient;
    if (!change.allFinite()) return out;
    out.position += change;
  }
  out.fault = TriangulationFault::kNone;
  return out;
}

}  // namespace capstan::vision
