#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/simulation/background.h"
#include "core/simulation/ray_grid.h"
#include "core/simulation/renderer.h"

namespace capstan::simulation {

/// Draws the tool into an image by ray casting: a shaft (cylinder) and the marker (sphere) with Lambert
/// shading. The signed distance to the silhouette gives the coverage of edge pixels; the mean over positions
/// during the exposure gives motion blur. All positions are in the camera frame.
class ToolPainter {
 public:
  ToolPainter(const vision::Camera& camera, const SceneSizes& sizes, const ImageTruth& appearance,
              const cv::Mat& light);

  /// `axis` is the unit vector from the tip up the shaft. During the exposure the marker moves by ±`smear`
  /// [m] about `tip` [m].
  void paint(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis, const Eigen::Vector3d& smear,
             cv::Mat& image);

 private:
  struct Cover {
    float share = 0.0F;  // covered share of the pixel
    float depth = 0.0F;  // depth along z [m]
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  };
  struct Span {
    int begin, end;
  };

  Cover marker(const Eigen::Vector3f& ray, const Eigen::Vector3f& centre) const;
  Cover shaft(const Eigen::Vector3f& ray, const Eigen::Vector3f& tip, const Eigen::Vector3f& axis) const;
  void paintShaft(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis, cv::Mat& image);
  void spanShaft(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis);
  void paintMarker(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis, const Eigen::Vector3d& smear,
                   cv::Mat& image) const;
  void blend(cv::Mat& image, int u, int v, const Eigen::Vector3f& colour, float share) const;

  vision::Camera camera_;
  RayGrid grid_;
  SceneSizes sizes_;
  cv::Mat light_;
  Eigen::Vector3f marker_colour_;
  std::vector<Span> spans_;  // columns of the shaft per image row
};

}  // namespace capstan::simulation
