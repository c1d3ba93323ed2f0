#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::diagnosis {

/// First or second derivative of equally spaced samples: that of the cubic fitted by least squares to the
/// samples within `half` of each (Savitzky and Golay 1964); near the ends, of the first or last such window.
/// `step` between samples; results per step's unit. Fewer than 2 half + 1 samples: one cubic (or what
/// degree they carry) over all of them. `half` ≥ 2, `order` 1 or 2, all finite.
std::vector<double> smoothDerivative(std::span<const double> values, double step, std::size_t half,
                                     int order = 1);

}  // namespace capstan::diagnosis
