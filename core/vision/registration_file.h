#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

#include "core/base/field.h"

namespace capstan::vision {

/// Allowed range of the numbers of a rotation in files: computed ones exceed 1 by rounding.
inline constexpr base::Range kRotationRange{-1.0 - 1e-6, 1.0 + 1e-6};
/// Whether `rotation` is one: orthonormal rows, determinant 1.
bool isRotation(const Eigen::Matrix3d& rotation);
/// Reads base_from_camera from a registration file (YAML). Throws base::InputError with file, key and remedy,
/// also for a rotation that is none.
Eigen::Isometry3d readRegistration(const std::filesystem::path& path);
/// Text of a registration file.
std::string formatRegistration(const Eigen::Isometry3d& base_from_camera);
void writeRegistration(const Eigen::Isometry3d& base_from_camera, const std::filesystem::path& path);

}  // namespace capstan::vision
