#pragma once

#include <string>
#include <string_view>

#include "core/base/units.h"

namespace capstan::diagnosis {

/// Displacement from which on an effect is material and reported as a cause. Smaller effects are reported as also measurable.
/// The tolerance changes neither what is fitted nor which effects are selected.
struct Tolerance {
  double angle = 0.02 * base::kRadiansPerDegree;  ///< [rad]; default: four counts of the UKF paper's reference encoders
  double length = 1e-5;                           ///< [m]; default: two counts of its linear encoder
};

/// Parses "0.02deg,0.01mm": angle and length in any order, either may be missing and then keeps its default. Units: deg, rad,
/// mm, um, m. Throws base::InputError with `option` for any other text.
Tolerance parseTolerance(std::string_view text, const std::string& option);
/// "0.02deg,0.01mm"
std::string formatTolerance(const Tolerance& tolerance);

}  // namespace capstan::diagnosis
