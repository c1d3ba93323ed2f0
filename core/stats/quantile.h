#pragma once

#include <span>
#include <vector>

namespace capstan::stats {

/// Sample quantile with linear interpolation between order statistics: Hyndman and Fan (1996), type 7, the
/// default of R and NumPy: x_⌊h⌋ + (h − ⌊h⌋)(x_⌊h⌋+1 − x_⌊h⌋) with h = (n − 1) p. `share` is p in [0, 1]. NaN
/// values are excluded; returns NaN when no value remains.
double quantile(std::span<const double> values, double share);
/// Sample quantiles as quantile(), in the order of `shares`; the values are sorted only once.
std::vector<double> quantiles(std::span<const double> values, std::span<const double> shares);
double median(std::span<const double> values);

}  // namespace capstan::stats
