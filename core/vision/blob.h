#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vision/bit_image.h"

namespace capstan::vision {

/// Set of 8-connected pixels, in pixels of the searched region.
struct Blob {
  int area = 0;                  ///< set pixels
  int first_x = 0, first_y = 0;  ///< leftmost pixel of its topmost row
  int left = 0, right = 0, top = 0, bottom = 0;
};

/// Outer contour through the centres of boundary pixels, as cv::findContours (CHAIN_APPROX_NONE) gives it.
struct ContourMoments {
  double area = 0.0;                                   ///< of the polygon [px²]
  double perimeter = 0.0;                              ///< [px]
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< of the polygon (Green's theorem), holes filled
};

struct ContourPoint {
  std::int16_t x, y;
};

/// Blobs and contours on bit rows. Storage is fixed at construction.
class BlobFinder {
 public:
  BlobFinder(int max_width, int max_height);

  /// All blobs of `image`, whose set pixels lie in `rows` and whose runs are at least three pixels long (true
  /// after a 3×3 dilation); largest area first. Valid until the next call.
  std::span<const Blob> find(const BitImage& image, RowSpan rows);
  /// Follows the outer border of `blob`.
  ContourMoments trace(const BitImage& image, const Blob& blob);
  std::span<const ContourPoint> contour() const { return contour_; }

 private:
  struct Run {
    std::int16_t begin, end;  ///< [begin, end)
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
