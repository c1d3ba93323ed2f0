#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

#include "core/base/names.h"
#include "core/base/result.h"
#include "core/vision/marker.h"

namespace capstan::vision {

/// Reason why a click does not select a marker.
enum class PickFault { kOutside, kNoColour, kTooSmall, kBackground };

struct PickedMarker {
  MarkerOptions options;
  MarkerDetection mark;  ///< the marker of the click, found with `options`
  /// Other areas of the image that are inside the limits [px], and the largest of them. One of
  /// options.candidate_ratio of the marker's area or more makes a search of the whole frame ambiguous.
  int background = 0, largest_background = 0;
  bool ambiguous() const { return largest_background >= options.candidate_ratio * mark.area; }
};

/// Chooses the HSV and shape limits of the marker at `pixel` of an 8-bit BGR image. The marker's pixels are
/// the connected ones of the colour there. Each hue limit is half-way from their median hue to the median hue
/// of the rest of the image on that side, at most 30° (15 units) away. Lowest saturation and value are 0.5
/// and 0.6 of their medians. While another area of the image could be taken for the marker, the limits move
/// towards the marker's own colours. Smallest radius: half of the marker's; smallest circularity: 0.4 of the
/// marker's.
base::Result<PickedMarker, PickFault> pickMarker(const cv::Mat& bgr, const cv::Point& pixel);

}  // namespace capstan::vision

template <>
struct capstan::base::NamesOf<capstan::vision::PickFault> {
  using F = capstan::vision::PickFault;
  static constexpr std::array value = {std::pair{F::kOutside, "the pixel is outside the image"},
                                       std::pair{F::kNoColour, "the pixel has no colour"},
                                       std::pair{F::kTooSmall, "the area of this colour is too small"},
                                       std::pair{F::kBackground, "the area of this colour is too large"}};
};
