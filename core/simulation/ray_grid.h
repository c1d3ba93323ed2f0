#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/vision/camera.h"

namespace capstan::simulation {

/// Rays of a ray caster: normalised image coordinates (x/z, y/z) of every pixel's centre, with the lens
/// distortion removed.
class RayGrid {
 public:
  explicit RayGrid(const vision::Camera& camera) : width_(camera.width), height_(camera.height) {
    rays_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) rays_.push_back(camera.normalise(Eigen::Vector2d(u, v)).cast<float>());
  }

  /// Direction of pixel (u, v), z = 1.
  Eigen::Vector3f ray(int u, int v) const {
    return rays_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)]
        .homogeneous();
  }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  std::vector<Eigen::Vector2f> rays_;
};

}  // namespace capstan::simulation
