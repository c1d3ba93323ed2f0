#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vision/bit_image.h"

namespace capstan::vision {

/// 8-connected group of pixels whose bit is 1. Coordinates are pixels of the searched region.
struct Blob {
  int area = 0;                  ///< number of pixels
  int first_x = 0, first_y = 0;  ///< leftmost pixel of the topmost row
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// Moments of a blob's outer contour, the polygon through the centres of the boundary pixels as
/// cv::findContours (CHAIN_APPROX_NONE) returns it.
struct ContourMoments {
  double area = 0.0;                                   ///< area of the polygon [px²]
  double perimeter = 0.0;                              ///< perimeter of the polygon [px]
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< centroid (Green's theorem) with filled holes [px]
};

struct ContourPoint {
  std::int16_t x, y;
};

/// Finds blobs and contours in a BitImage. Storage is fixed at construction.
class BlobFinder {
 public:
  BlobFinder(int max_width, int max_height);

  /// Returns all blobs of `image`, largest area first; valid until the next call. All set pixels must lie in
  /// `rows`, and all horizontal runs must be at least three pixels long (as after a 3×3 dilation).
  std::span<const Blob> find(const BitImage& image, RowSpan rows);
  /// Follows the outer border of `blob`; returns its moments and sets contour().
  ContourMoments trace(const BitImage& image, const Blob& blob);
  std::span<const ContourPoint> contour() const { return contour_; }

 private:
  struct Run {
    std::int16_t begin, end;  ///< columns [begin, end)
    std::int32_t label;
  };
  std::int32_t root(std::int32_t label);
  void join(Run& run, std::int32_t other);

  std::vector<Run> runs_;
  std::vector<std::int32_t> parents_;
  std::vector<Blob> blobs_;
  std::vector<ContourPoint> contour_;
};

}  // namespace capstan::vision
