#pragma once

namespace capstan::stats {

/// Base-10 logarithm of the two-sided P of Student's t with ν > 0 degrees of freedom (not necessarily an
/// integer),
///   P = I_x(ν/2, 1/2), x = ν / (ν + t²)    (Abramowitz and Stegun 26.7.1 with 26.5.27).
/// Accurate to about 13 digits for every P: when P is near the smallest double, the logarithm comes directly
/// from the continued fraction of the incomplete beta function (DLMF 8.17.22). 0 at t = 0; t is finite.
double log10TwoSidedP(double t, double degrees_of_freedom);

}  // namespace capstan::stats
