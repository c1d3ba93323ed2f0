#include "core/vision/registration.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace capstan::vision {

namespace {

bool allFinite(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points)
    if (!point.allFinite()) return false;
  return true;
}

Eigen::Vector3d mean(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Cross-product matrix [v]ₓ: v × w = crossMatrix(v) w.
Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Standard deviations of translation and rotation from the residuals: s² (Σ JᵀJ)⁻¹ with J = [1, −[R c]ₓ].
void fillSigma(std::span<const Eigen::Vector3d> points_camera, double squares, Registration& found) {
  const double freedom = 3.0 * static_cast<double>(points_camera.size()) - 6.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Eigen::Vector3d& point : points_camera) {
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << Eigen::Matrix3d::Identity(), -crossMatrix(found.base_from_camera.linear() * point);
    information += jacobian.transpose() * jacobian;
  }
  const Eigen::Matrix<double, 6, 1> variance = squares / freedom * information.inverse().diagonal();
  found.sigma = variance.head<3>().cwiseMax(0.0).cwiseSqrt();
  found.sigma_rotation = variance.tail<3>().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace

base::Result<Registration, RegistrationFault> registerAtHardStop(
    std::span<const Eigen::Vector3d> points_camera, const Eigen::Matrix3d& base_R_camera,
    const Eigen::Vector3d& marker_in_base) {
  if (points_camera.size() < 2) return base::failure(RegistrationFault::kTooFewPoints);
  if (!allFinite(points_camera) || !base_R_camera.allFinite() || !marker_in_base.allFinite())
    return base::failure(RegistrationFault::kNotFinite);
  const double n = static_cast<double>(points_camera.size());
  const Eigen::Vector3d middle = mean(points_camera);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points_camera)
    squares += (base_R_camera * (point - middle)).cwiseAbs2();

  Registration found;
  found.base_from_camera.linear() = base_R_camera;
  found.base_from_camera.translation() = marker_in_base - base_R_camera * middle;  // UKF paper (1)
  found.sigma = (squares / (n - 1.0) / n).cwiseSqrt();
  found.rms = std::sqrt(squares.sum() / n);
  found.frames = static_cast<int>(points_camera.size());
  return found;
}

base::Result<Registration, RegistrationFault> registerRigid(std::span<const Eigen::Vector3d> points_camera,
                                                            std::span<const Eigen::Vector3d> points_base) {
  if (points_camera.size() != points_base.size()) return base::failure(RegistrationFault::kUnequalCounts);
  if (points_camera.size() < 3) return base::failure(RegistrationFault::kTooFewPoints);
  if (!allFinite(points_camera) || !allFinite(points_base))
    return base::failure(RegistrationFault::kNotFinite);
  const Eigen::Vector3d middle_camera = mean(points_camera), middle_base = mean(points_base);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero(), extent_camera = covariance, extent_base = covariance;
  for (std::size_t i = 0; i < points_camera.size(); ++i) {
    const Eigen::Vector3d c = points_camera[i] - middle_camera, b = points_base[i] - middle_base;
    covariance += b * c.transpose();
    extent_camera += c * c.transpose();
    extent_base += b * b.transpose();
  }
  // For points on one line the second largest extent is zero and the rotation about the line is undetermined.
  constexpr double kThin = 1e-4;  // smallest ratio of width to length of the points
  for (const Eigen::Matrix3d& extent : {extent_camera, extent_base}) {
    const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::Matrix3d>(extent).singularValues();
    if (!(sizes(1) > kThin * kThin * sizes(0))) return base::failure(RegistrationFault::kCollinear);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;  // no reflection

  Registration found;
  found.base_from_camera.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  found.base_from_camera.translation() = middle_base - found.base_from_camera.linear() * middle_camera;
  double squares = 0.0;
  for (std::size_t i = 0; i < points_camera.size(); ++i)
    squares += (found.base_from_camera * points_camera[i] - points_base[i]).squaredNorm();
  found.rms = std::sqrt(squares / static_cast<double>(points_camera.size()));
  found.frames = static_cast<int>(points_camera.size());
  fillSigma(points_camera, squares, found);
  return found;
}

}  // namespace capstan::vision
