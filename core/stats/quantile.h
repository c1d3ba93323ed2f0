#pragma once

#include <span>
#include <vector>

namespace capstan::stats {

/// Sample quantile with linear interpolation between order statistics: Hyndman and Fan (1996), type 7, as R
/// and NumPy give it by default: h = (n − 1) p, x_⌊h⌋ + (h − ⌊h⌋)(x_⌊h⌋+1 − x_⌊h⌋).
/// `share` p in [0, 1]. NaN values are excluded; NaN when none remain.
double quantile(std::span<const double> values, double share);
/// Several at the cost of one sort, in the order of `shares`.
std::vector<double> quantiles(std::span<const double> values, std::span<const double> shares);
double median(std::span<const double> values);

}  // namespace capstan::stats
