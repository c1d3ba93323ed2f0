#include "core/learning/poses/pose_features.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {
namespace {

/// Angle in ±π.
double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

Eigen::Vector3d yawPitchRoll(const Eigen::Matrix3d& r) {
  const double cosine = std::hypot(r(0, 0), r(1, 0)), pitch = std::atan2(-r(2, 0), cosine);
  if (cosine < 1e-9) return {std::atan2(-r(0, 1), r(1, 1)), pitch, 0.0};
  return {std::atan2(r(1, 0), r(0, 0)), pitch, std::atan2(r(2, 1), r(2, 2))};
}

Eigen::Matrix3d fromYawPitchRoll(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Quaterniond meanRotation(const std::vector<Eigen::Isometry3d>& poses) {
  if (poses.empty()) return Eigen::Quaterniond::Identity();
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Eigen::Isometry3d& pose : poses) {
    const Eigen::Vector4d q = Eigen::Quaterniond(pose.linear()).coeffs();
    sum += q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  return Eigen::Quaterniond(Eigen::Vector4d(solver.eigenvectors().col(3))).normalized();
}

PoseFeatures::PoseFeatures(RotationForm form, Motion motion, const Eigen::Quaterniond& middle)
    : form_(form), motion_(motion), middle_(middle) {}

Eigen::Index PoseFeatures::size() const {
  switch (motion_) {
    case Motion::kNone:
      return 6;
    case Motion::kVelocity:
      return 12;
    default:
      return 12 + 6 * static_cast<Eigen::Index>(kSpans.size());
  }
}

Eigen::RowVectorXd PoseFeatures::of(const Eigen::Isometry3d& offset, const State& observed) const {
  const Eigen::Isometry3d pose = offset * observed.pair.observed;
  Eigen::RowVectorXd features(size());
  features.head<3>() = pose.translation().transpose();
  if (form_ == RotationForm::kTangent)
    features.segment<3>(3) =
        rotationVector(middle_.conjugate() * Eigen::Quaterniond(pose.linear())).transpose();
  else
    features.segment<3>(3) = yawPitchRoll(pose.linear()).transpose();
  const auto put = [&](Eigen::Index at, const Vector6d& velocity) {  // rotation rates stay in the tool frame
    features.segment<3>(at) = (offset.linear() * velocity.head<3>()).transpose();
    features.segment<3>(at + 3) = velocity.tail<3>().transpose();
  };
  if (motion_ != Motion::kNone) put(6, observed.velocity);
  for (std::size_t i = 0; i < kSpans.size() && motion_ == Motion::kHistory; ++i)
    put(12 + 6 * static_cast<Eigen::Index>(i), observed.drift[i]);
  return features;
}

Vector6d PoseFeatures::correction(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  Vector6d correction;
  correction.head<3>() = to.translation() - from.translation();
  if (form_ == RotationForm::kTangent) {
    correction.tail<3>() =
        rotationVector(Eigen::Quaterniond(from.linear()).conjugate() * Eigen::Quaterniond(to.linear()));
  } else {
    const Eigen::Vector3d angles = yawPitchRoll(to.linear()) - yawPitchRoll(from.linear());
    correction.tail<3>() = angles.unaryExpr(&wrapped);
  }
  return correction;
}

Eigen::Isometry3d PoseFeatures::corrected(const Eigen::Isometry3d& from, const Vector6d& correction) const {
  Eigen::Isometry3d to = Eigen::Isometry3d::Identity();
  to.translation() = from.translation() + correction.head<3>();
  if (form_ == RotationForm::kTangent)
    to.linear() = from.linear() * turnBy(correction.tail<3>()).toRotationMatrix();
  else
    to.linear() = fromYawPitchRoll(yawPitchRoll(from.linear()) + correction.tail<3>());
  return to;
}

}  // namespace capstan::learning
