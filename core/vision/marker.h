#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

#include "core/base/field.h"
#include "core/base/names.h"

namespace capstan::vision {

/// Reason why no marker was found.
enum class MarkerFault { kNone, kNoImage, kNoPixels, kTooSmall, kNotRound, kTwoCandidates, kWrongImage };

/// HSV threshold and shape limits of the UKF paper's section II-B. Hue wraps at 180 if hue_low > hue_high.
struct MarkerOptions {
  int hue_low = 45, hue_high = 85;  ///< OpenCV hue, 0…179
  int saturation_low = 90;          ///< 0…255
  int value_low = 40;               ///< 0…255
  double min_radius = 3.0;          ///< smallest radius of the circle [px]
  double min_circularity = 0.75;    ///< smallest 4 pi area / perimeter²
  double candidate_ratio = 0.5;     ///< share of the largest area from which a blob is a second candidate
  int roi_size = 100;               ///< side of the square region of interest [px]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.hue_low, {"hue_low", "", "lowest hue (OpenCV, 0-179)", {0, 179}, false});
    field(self.hue_high, {"hue_high", "", "highest hue", {0, 179}, false});
    field(self.saturation_low, {"saturation_low", "", "lowest saturation", {0, 255}, false});
    field(self.value_low, {"value_low", "", "lowest value", {0, 255}, false});
    field(self.min_radius, {"min_radius", "px", "smallest circle", {0.5, 320}, false});
    field(self.min_circularity, {"min_circularity", "", "4 pi area / perimeter^2", {0, 1}, false});
    field(self.candidate_ratio,
          {"candidate_ratio", "", "area share that makes a second candidate", {0, 1}, false});
    field(self.roi_size, {"roi_size", "px", "side of the region of interest", {16, 480}, false});
  }
};

/// Marker in one image. Pixels are those of the whole frame, with the lens's distortion.
struct MarkerDetection {
  MarkerFault fault = MarkerFault::kNoImage;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< sub-pixel [px]
  Eigen::Vector2d contour_centroid =
      Eigen::Vector2d::Zero();  ///< centroid of the mask's contour, as in the paper [px]
  double radius = 0.0;          ///< radius of the fitted circle [px]
  double sigma = 0.0;           ///< standard deviation of the centroid, per axis [px]
  double circularity = 0.0;     ///< 4 pi area / perimeter² of the contour
  int area = 0;                 ///< area of the blob [px]
  std::array<int, 4> roi{};     ///< searched region: x, y, width, height [px]
  bool full_frame = false;      ///< whether the whole frame was searched
  bool found() const { return fault == MarkerFault::kNone; }
};

}  // namespace capstan::vision

template <>
struct capstan::base::NamesOf<capstan::vision::MarkerFault> {
  using F = capstan::vision::MarkerFault;
  static constexpr std::array value = {std::pair{F::kNone, "ok"},
                                       std::pair{F::kNoImage, "no image"},
                                       std::pair{F::kNoPixels, "no pixels of the marker's colour"},
                                       std::pair{F::kTooSmall, "too small"},
                                       std::pair{F::kNotRound, "not round"},
                                       std::pair{F::kTwoCandidates, "two candidates"},
                                       std::pair{F::kWrongImage, "image of another size or format"}};
};
