#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::diagnosis {

/// First or second derivative of equally spaced samples, by Savitzky and Golay (1964): at each sample the
/// derivative of a cubic fitted by least squares to the `half` samples on either side. Near the ends, the
/// first or last full window is used. `step` is the time between samples; derivatives are per unit of `step`.
/// Fewer than 2 half + 1 samples share one cubic, or a lower degree if they are fewer than four. `half` ≥ 2,
/// `order` 1 or 2, all values finite.
std::vector<double> smoothDerivative(std::span<const double> values, double step, std::size_t half,
                                     int order = 1);

}  // namespace capstan::diagnosis
