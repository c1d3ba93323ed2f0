#pragma once

#include <string>

#include "core/tracking/options.h"

namespace capstan::tracking {

/// Options of `after` that differ from `before`, as in their file: "one_camera: ray, gate_probability: 0.99".
/// Empty: none differs.
std::string optionChanges(const TrackingOptions& before, const TrackingOptions& after);

}  // namespace capstan::tracking
