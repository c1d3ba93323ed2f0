#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace capstan::vision {

/// Pinhole camera with the OpenCV (plumb_bob) distortion model. Pixel (0, 0) is the centre of the top-left
/// pixel. Camera frame: x right, y down, z along the view.
struct Camera {
  std::string name = "camera";
  int width = 640;                                ///< [px]
  int height = 480;                               ///< [px]
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< focal lengths and principal point [px]
  std::array<double, 5> distortion{};             ///< k1, k2, p1, p2, k3

  /// Pixel of a point in the camera frame [m]; std::nullopt when the point is not in front of the camera.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;
  /// Normalised image coordinates (x/z, y/z) of a pixel. Newton steps remove the distortion to 1e-12.
  Eigen::Vector2d normalise(const Eigen::Vector2d& pixel) const;
};

/// Two cameras fixed to each other. The rig's frame is the left camera's.
struct StereoRig {
  Camera left, right;
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  double baseline() const { return right_from_left.translation().norm(); }  ///< [m]
};

/// Reads two ROS camera_info YAML files (camera_calibration format). The right projection_matrix and both
/// rectification matrices contain the extrinsics. Throws base::InputError with file, line, key and remedy.
StereoRig readStereoRig(const std::filesystem::path& left, const std::filesystem::path& right);
void writeStereoRig(const StereoRig& rig, const std::filesystem::path& left,
                    const std::filesystem::path& right);
/// Read and write the same YAML as texts, which session files contain.
StereoRig parseStereoRig(const std::string& left, const std::string& right);
std::array<std::string, 2> formatStereoRig(const StereoRig& rig);

}  // namespace capstan::vision
