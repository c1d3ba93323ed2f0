#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/simulation/truth.h"
#include "core/vision/camera.h"

namespace capstan::simulation {

/// Pose of the tool during one exposure, in frame 0. The marker moves by ±velocity · exposure / 2 about
/// `tip`.
struct ToolPose {
  Eigen::Vector3d tip;       ///< centre of the marker sphere at mid exposure [m]
  Eigen::Vector3d velocity;  ///< velocity of the tip [m/s]
  Eigen::Vector3d axis;      ///< unit vector from the tip up the shaft
};

/// Output of a perfect detector for one image at mid exposure, as if nothing covered the marker.
struct RenderedMarker {
  Eigen::Vector2d sphere_centre = Eigen::Vector2d::Zero();   ///< projection of the sphere's centre [px]
  Eigen::Vector2d ellipse_centre = Eigen::Vector2d::Zero();  ///< area centroid of its outline [px]
  double radius = 0.0;   ///< radius of a circle with the outline's area [px]
  bool in_view = false;  ///< the whole outline lies in the image
};

/// Sizes of the marker and the shaft.
struct SceneSizes {
  double marker_radius = 0.005;  ///< [m]
  double shaft_radius = 0.003;   ///< [m]
  double shaft_length = 0.47;    ///< [m]
};

/// Renders the images of one camera. Ray casting through the distorted pixel grid draws a shaded marker
/// sphere and shaft in front of a fixed background, with motion blur, uneven light, exposure noise and colour
/// noise. Same seed, same bytes.
class CameraRenderer {
 public:
  /// `camera_from_base` is the true pose. `exposure` is the shutter time [s]. `seed` determines background
  /// and noise. `side` is 0 for the left camera of a rig and 1 for the right one; the right one has the same
  /// background, shifted, and noise of its own.
  CameraRenderer(const vision::Camera& camera, const Eigen::Isometry3d& camera_from_base,
                 const SceneSizes& sizes, const ImageTruth& appearance, double exposure, std::uint64_t seed,
                 int side);
  ~CameraRenderer();
  CameraRenderer(CameraRenderer&&) noexcept;

  /// Draws into `image` (8-bit BGR; allocated only when its size or type differs).
  void render(const ToolPose& pose, cv::Mat& image);
  /// Exact outline of the marker; draws nothing.
  RenderedMarker outline(const ToolPose& pose) const;

 private:
  struct Drawing;

  vision::Camera camera_;
  Eigen::Isometry3d camera_from_base_;
  SceneSizes sizes_;
  ImageTruth appearance_;
  double exposure_;
  std::uint64_t seed_;
  int side_;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace capstan::simulation
