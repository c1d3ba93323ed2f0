#pragma once

namespace capstan::stats {

/// log10 of the two-sided P of Student's t with ν > 0 degrees of freedom (not necessarily whole),
///   P = I_x(ν/2, 1/2), x = ν / (ν + t²)    (Abramowitz and Stegun 26.7.1 with 26.5.27),
/// to some 13 digits however small P is: where P nears what a double can hold, the continued fraction of the
/// incomplete beta function (DLMF 8.17.22) gives its logarithm directly. 0 at t = 0. `t` finite.
double log10TwoSidedP(double t, double degrees_of_freedom);

}  // namespace capstan::stats
