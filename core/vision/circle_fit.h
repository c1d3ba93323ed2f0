#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/vision/blob.h"
#include "core/vision/marker.h"

namespace capstan::vision {

struct Circle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [px]
  double radius = 0.0;                               ///< [px]
};

/// Circle of least algebraic distance (Kåsa 1976) through contour points, those on the border of a width ×
/// height region excluded. Radius 0 when fewer than six remain.
Circle fitContourCircle(std::span<const ContourPoint> contour, int width, int height);

struct CircleFit {
  Circle circle;
  double rms = 0.0;       ///< robust residual of the edge points [px]
  double sigma = 0.0;     ///< standard deviation of the centre, per axis, from the residuals [px]
  int edges = 0;          ///< edge points that agree
  double coverage = 0.0;  ///< share of the circle's directions that have an agreeing edge
  bool valid = false;
};

/// Refines a circle on the image itself: along rays from the centre, the colour component towards the
/// marker's hue (linear in R, G, B, zero for grey) falls from the marker's level to the background's; its
/// half-way point is an edge point, whatever the shading across the marker. A circle is fitted to the edge
/// points by Gauss–Newton steps with Tukey weights, so that a tool shaft or an occluder over part of the edge
/// does not pull it.
class EdgeSampler {
 public:
  explicit EdgeSampler(const MarkerOptions& options);

  static constexpr int kRays = 48;
  struct Edges {
    std::array<Eigen::Vector2d, kRays> points;
    int count = 0;
  };

  CircleFit refine(const cv::Mat& bgr, const Circle& start);

 private:
  /// Colour component of the pixels around a circle, every stride-th (1 up to radii of 43 px) from (x, y) on.
  struct Patch {
    int x = 0, y = 0, width = 0, height = 0, stride = 1;
  };
  static constexpr int kPatchSide = 96;

  Patch takePatch(const cv::Mat& bgr, const Circle& circle);
  Edges collectEdges(const Circle& circle, const Patch& patch, int stride) const;

  std::array<float, 3> weights_;  ///< of B, G, R
  std::vector<float> chroma_;     ///< kPatchSide columns a row
};

}  // namespace capstan::vision
