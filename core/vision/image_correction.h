#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <string>

namespace capstan::vision {

/// What is done to the images of a source before they are used and recorded: left and right are exchanged
/// first; then each is mirrored left to right, turned upside down, or both (a rotation by 180°).
struct ImageCorrection {
  bool exchange = false;
  std::array<bool, 2> mirror{}, flip{};  ///< left, right: columns reversed, rows reversed

  bool none() const { return *this == ImageCorrection{}; }
  bool operator==(const ImageCorrection&) const = default;

  /// Corrects a pair of images in place.
  void apply(cv::Mat& left, cv::Mat& right) const;
  /// Pixel of the corrected images where `left` and `right` are pixels of images of `width` × `height` [px].
  std::array<Eigen::Vector2d, 2> apply(const Eigen::Vector2d& left, const Eigen::Vector2d& right, int width,
                                       int height) const;
  /// The correction that first does this one and then `next`.
  ImageCorrection then(const ImageCorrection& next) const;
  /// "cameras exchanged, left image mirrored"; empty: nothing is done.
  std::string words() const;
};

}  // namespace capstan::vision
