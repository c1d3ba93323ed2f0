#include "core/registration/camera_order.h"

#include <cmath>

namespace capstan::registration {

CameraOrder cameraOrder(const vision::Triangulator& triangulator,
                        const std::array<vision::MarkerDetection, 2>& marker, double epipolar_limit) {
  const auto meet = [&](const vision::MarkerDetection& left, const vision::MarkerDetection& right) {
    constexpr double kSigma = 1.0;  // [px], equal for both: only the intersection of the rays matters
    const auto found = triangulator.triangulate(left.centroid, right.centroid, kSigma, kSigma);
    return found.found() && std::abs(found.epipolar_residual) <= epipolar_limit;
  };
  if (meet(marker[0], marker[1])) return CameraOrder::kFits;
  return meet(marker[1], marker[0]) ? CameraOrder::kExchanged : CameraOrder::kNoFit;
}

}  // namespace capstan::registration
