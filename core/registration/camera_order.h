#pragma once

#include <array>

#include "core/vision/marker.h"
#include "core/vision/triangulation.h"

namespace capstan::registration {

/// Order of the cameras according to the rays of two detections of one marker.
enum class CameraOrder {
  kFits,       ///< the rays meet in front of both cameras
  kExchanged,  ///< the rays meet in front of both cameras only when the two detections are exchanged
  kNoFit,      ///< the rays do not meet in either order
};

/// Distance of a pixel from the other pixel's epipolar line beyond which two views show different points
/// [px]; the limit of tracking.
inline constexpr double kEpipolarLimit = 3.0;

/// Determines the order from the left and the right detection, which must both be found. `epipolar_limit`
/// [px] is the largest distance of a pixel from the other pixel's epipolar line at which the rays count as
/// meeting.
CameraOrder cameraOrder(const vision::Triangulator& triangulator,
                        const std::array<vision::MarkerDetection, 2>& marker, double epipolar_limit);

}  // namespace capstan::registration
