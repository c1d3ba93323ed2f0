#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace capstan::base {

/// Whether a 4 × 4 matrix is a rigid transform: finite, with a rotation (orthonormal to 1e-6, no reflection)
/// and the last row 0 0 0 1.
inline bool isRigid(const Eigen::Matrix4d& matrix) {
  constexpr double kOrthonormal = 1e-6;
  if (!matrix.allFinite() || matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) return false;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d excess = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  return (excess.array().abs() <= kOrthonormal).all() && rotation.determinant() > 0.0;
}

}  // namespace capstan::base
