#pragma once

#include <string>
#include <string_view>

#include "core/base/units.h"

namespace capstan::diagnosis {

/// Displacement of a joint or the tip from which on an effect is material and reported as a cause. Smaller
/// effects are reported as also measurable. The tolerance changes neither the fits nor the selection.
struct Tolerance {
  double angle =
      0.02 * base::kRadiansPerDegree;  ///< [rad]; default: four counts of the UKF paper's reference encoders
  double length = 2e-5;                ///< [m]; default: four counts of that paper's linear encoder
};

/// Parses "0.02deg,0.02mm": angle and length in any order. A missing one keeps its default. Units: deg, rad,
/// mm, um, m. Throws base::InputError, with the name `option`, for any other text.
Tolerance parseTolerance(std::string_view text, const std::string& option);
/// Text that parseTolerance() reads, "0.02deg,0.02mm".
std::string formatTolerance(const Tolerance& tolerance);

}  // namespace capstan::diagnosis
