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

/// Circle of least algebraic distance (Kåsa 1976) through the contour points, without those on the border of
/// the width × height region. The radius is 0 when fewer than six points remain.
Circle fitContourCircle(std::span<const ContourPoint> contour, int width, int height);

struct CircleFit {
  Circle circle;
  double rms = 0.0;       ///< robust residual of the edge points [px]
  double sigma = 0.0;     ///< standard deviation of the centre per axis, from the residuals [px]
  int edges = 0;          ///< number of inlier edge points
  double coverage = 0.0;  ///< share of the directions around the circle that have an inlier edge point
  bool valid = false;
};

/// Refines a circle with the colours of the image. Along each ray from the centre, the colour component
/// towards the marker's hue (linear in R, G, B, zero for grey) falls from the level of the marker to that of
/// the background. Its half-way point is an edge point and does not depend on the shading across the marker.
/// A circle is fitted to the edge points by Gauss–Newton steps with Tukey weights, so that a tool shaft or an
/// occluder in front of part of the edge does not shift it.
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
  /// Region from (x, y) around a circle, of which every stride-th pixel is read (1 up to radii of 43 px).
  struct Patch {
    int x = 0, y = 0, width = 0, height = 0, stride = 1;
  };
  static constexpr int kPatchSide = 96;

  Patch takePatch(const cv::Mat& bgr, const Circle& circle);
  Edges collectEdges(const Circle& circle, const Patch& patch, int stride) const;

  std::array<float, 3> weights_;  ///< weights of B, G, R in the colour component
  std::vector<float> chroma_;     ///< colour component of the patch, kPatchSide columns per row
};

}  // namespace capstan::vision
