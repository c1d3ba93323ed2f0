#pragma once

#include <array>

#include "core/vision/marker.h"
#include "core/vision/triangulation.h"

namespace capstan::registration {

/// What the rays of two detections of one marker say of the order of the cameras.
enum class CameraOrder {
  kFits,       ///< the rays meet in front of both cameras
  kExchanged,  ///< they do only when the left detection is taken for the right one
  kNoFit,      ///< they do not meet either way
};

/// Left and right detection, both found. `epipolar_limit` [px]: distance of a pixel from the other's epipolar
/// line within which the rays meet.
CameraOrder cameraOrder(const vision::Triangulator& triangulator,
                        const std::array<vision::MarkerDetection, 2>& marker, double epipolar_limit);

}  // namespace capstan::registration
